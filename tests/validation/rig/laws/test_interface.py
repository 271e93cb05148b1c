"""The laws of a piece of shaft: levels, bounds, and slopes against central differences."""

import math

import pytest

from validation.rig.laws.interface import (
    damping_share,
    dry,
    dry_share,
    interface,
    preslide,
    preslide_shared,
    saturating,
    viscous,
)
from validation.rig.laws.parameters import LawParameters

LAW = LawParameters(323.6, 0.018, 0.295)
LAWS = {
    "viscous": {},
    "power law": {"exponent": 0.6},
    "saturating": {"saturation": 0.8},
    "Coulomb": {"coulomb": 0.004},
    "stiction": {"kinetic": 0.002, "static": 0.005, "stribeck": 0.4},
    "one way": {"coulomb": 0.004, "asymmetry": 0.5},
    "ageing": {"coulomb": 0.002, "ageing": 0.001, "ageing_time": 0.5},
    "shared": {"shared": 0.01},
}
BEFORE = (0.0004, 0.0004, 0.0006, 2.0)  # presliding, its parts of shared friction, age


def torque(law, rate, travel):
    return interface(law, law.damping, BEFORE, (rate, travel, 0.0005), rate, 0.8)


@pytest.mark.parametrize("name", LAWS)
@pytest.mark.parametrize(("rate", "travel"), [(0.3, 0.0002), (-0.7, -0.0005), (0.5, 0.01)])
def test_slopes_are_the_derivatives_of_the_torque(name, rate, travel):
    """Central differences: O(h^2), and rounding of 1e-16 / h, are both below 1e-6 of the slope."""
    law, h = LAW._replace(**LAWS[name]), 1e-6
    _, per_rate, per_travel = torque(law, rate, travel)
    by_rate = (torque(law, rate + h, travel)[0] - torque(law, rate - h, travel)[0]) / (2 * h)
    by_travel = (torque(law, rate, travel + h)[0] - torque(law, rate, travel - h)[0]) / (2 * h)
    assert per_rate == pytest.approx(by_rate, rel=1e-5, abs=1e-9)
    assert per_travel == pytest.approx(by_travel, rel=1e-3, abs=1e-7)


def test_a_power_law_is_beta_times_rate_to_the_exponent():
    assert viscous(0.5, 0.02, 4.0)[0] == pytest.approx(0.04, rel=1e-9)
    assert viscous(0.5, 0.02, -4.0)[0] == pytest.approx(-0.04, rel=1e-9)
    assert viscous(1.0, 0.02, 4.0) == (0.08, 0.02)


def test_a_film_that_gives_way_tends_to_its_limit():
    assert saturating(0.5, 0.02, 0.5) == (pytest.approx(0.005), pytest.approx(0.005))
    assert saturating(0.5, 0.02, -1e6)[0] == pytest.approx(-0.01, rel=1e-5)


def test_shares_of_the_laws_over_slip_time_depth_and_speed():
    assert (damping_share(LAW, 9.0, 9.0), dry_share(LAW, 30.0, 2.0)) == (1.0, 1.0)
    worn = LAW._replace(worn_share=0.4, worn_angle=2.0, decay_share=0.5, decay_time=3.0)
    left = (1 - 0.4 * (1 - 1 / math.e)) * (1 - 0.5 * (1 - 1 / math.e))
    assert damping_share(worn, 2.0, 3.0) == pytest.approx(left)
    pressed = LAW._replace(pressing=2.0, relief_speed=1.5)
    assert dry_share(pressed, 50.0, -3.0) == pytest.approx(0.25 * math.exp(-2))


def test_presliding_sticks_until_its_limit_and_slips_there():
    assert preslide(0.1, 0.02, 0.03) == (pytest.approx(0.05), 1.0)
    assert preslide(0.1, 0.02, 5.0) == (0.1, 0.0)
    assert preslide(0.1, 0.02, -5.0) == (-0.1, 0.0)


def test_shared_presliding_is_returned_radially_to_its_disc():
    assert preslide_shared(0.1, 0.03, 0.04) == (0.03, 0.04, 1.0)
    turning, axial, _ = preslide_shared(0.1, 0.3, 0.4)
    assert math.hypot(turning, axial) == pytest.approx(0.1)
    assert turning / axial == pytest.approx(0.75)


@pytest.mark.parametrize(
    ("law", "age", "rate", "level"),
    [
        ({"coulomb": 0.004}, 0.0, 1.0, 0.004),
        ({"coulomb": 0.004, "asymmetry": 0.5}, 0.0, 1.0, 0.006),
        ({"coulomb": 0.004, "asymmetry": 0.5}, 0.0, -1.0, -0.002),
        ({"kinetic": 0.002, "static": 0.005, "stribeck": 0.4}, 0.0, 100.0, 0.002),
        ({"kinetic": 0.002, "static": 0.005, "stribeck": 0.4}, 0.0, 1e-9, 0.005),
        ({"coulomb": 0.002, "ageing": 0.001, "ageing_time": 0.5}, 0.5, 1.0, 0.002 + 0.001 * math.log(2)),
    ],
)
def test_a_slipping_contact_has_its_dry_level(law, age, rate, level):
    slip = math.copysign(1.0, rate)
    assert dry(LAW._replace(**law), age, 0.0, rate, slip)[0] == pytest.approx(level, rel=1e-9)


def test_a_lagged_level_has_no_slope_with_the_rate():
    law = LAW._replace(**LAWS["stiction"])
    _, per_rate, _ = interface(law, law.damping, BEFORE, (0.3, 0.01, 0.0), 0.2, 1.0)
    assert per_rate == law.damping
    assert interface(law, law.damping, BEFORE, (0.3, 0.01, 0.0), 0.3, 1.0)[1] < law.damping
