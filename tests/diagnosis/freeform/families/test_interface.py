"""Free laws of the interface: where they become effects of the library, they are these."""

import numpy as np
import pytest
from diagnosis_fixtures import turns
from free_forms import DAMPING, covered, same_readings

from diagnosis.effects import LIBRARY
from diagnosis.freeform.families.interface import SLOW_RAD_S, families
from diagnosis.replay.rig_parameters import NOMINAL

ANGLE = turns(6.0)
RANGES = covered(ANGLE, tip=ANGLE, speed=-1.0 * (np.arange(ANGLE.size) > ANGLE.size // 2))
FAMILIES = {family.name: family for family in families(RANGES)}
LEVEL, SCALE = 0.001, 1.2
DRY = LIBRARY["coulomb_friction"].apply(NOMINAL, LEVEL)
THICK = LIBRARY["damping_error"].apply(NOMINAL, SCALE)


def rig_of(name, *first, straight=0.0):
    """The rig with a law whose curve is constant."""
    family = FAMILIES[name]
    rest = len(family.effect.parameters) - len(first)
    own = () if rest == 0 else (straight, *[0.0] * (rest - 1))
    return family.effect.apply(NOMINAL, *first, *own)


@pytest.mark.parametrize("name", [n for n in FAMILIES if n.startswith("damping over")])
def test_damping_times_a_constant_is_damping_of_another_size(name):
    # Parts of the shaft meet in places of their own: another mesh, second order in its elements.
    within = 1e-3 if name == "damping over position" else 1e-6
    assert same_readings(ANGLE, rig_of(name), NOMINAL, within=within)
    constant = SCALE - 1.0 if name == "damping over position" else np.log(SCALE)
    assert same_readings(ANGLE, rig_of(name, straight=constant), THICK, within=within)
    assert not same_readings(ANGLE, rig_of(name, straight=0.1), NOMINAL, within=within)


@pytest.mark.parametrize("name", [n for n in FAMILIES if n.startswith("dry friction over")])
def test_dry_friction_times_one_is_that_of_the_library(name):
    assert same_readings(ANGLE, rig_of(name, LEVEL), DRY)
    assert same_readings(ANGLE, rig_of(name, LEVEL / SCALE, straight=np.log(SCALE)), DRY)


def test_friction_as_strong_both_ways_is_that_of_the_library():
    assert same_readings(ANGLE, rig_of("friction over direction", LEVEL, 0.0, 0.0), DRY)
    assert not same_readings(ANGLE, rig_of("friction over direction", LEVEL, 0.3, 0.0), DRY)


def test_friction_one_way_turned_the_other_way_is_its_mirror_image():
    """asymmetry a at theta(t) is what -a is at -theta(t), with the sign of the readings turned."""
    one, other = (rig_of("friction over direction", LEVEL, a, 0.5 * a) for a in (0.4, -0.4))
    assert same_readings(ANGLE, one, other, mirrored=True)
    assert not same_readings(ANGLE, one, one, mirrored=True)


def test_a_variable_that_the_log_does_not_have_has_no_law():
    still = covered(ANGLE, tip=ANGLE)
    left_out = set(FAMILIES) - {family.name for family in families(still)}
    assert left_out == {
        "damping over axial_speed",
        "damping over slid_lately",
        "damping over pushed_lately",
        "damping over rested",
        "dry friction over slid_lately",
        "dry friction over pushed_lately",
        "dry friction over rested",
        "dry friction over axial_speed",
    }


def test_curves_are_told_in_the_units_of_the_needle():
    x, y = FAMILIES["damping over time"].curve(*[0.0] * 8)
    np.testing.assert_allclose(y, DAMPING)
    assert (x[0], x[-1]) == pytest.approx(RANGES.ends["time"])
    ways, both = FAMILIES["friction over direction"].curve(LEVEL, 0.5, -0.2)
    assert ways == (-1.0, 1.0)
    slow = DAMPING * SLOW_RAD_S
    assert both == pytest.approx([0.5 * LEVEL + 1.2 * slow, 1.5 * LEVEL + 0.8 * slow])
    place, damping = FAMILIES["damping over position"].curve(*[0.0] * 6)
    np.testing.assert_allclose(damping, DAMPING)
    assert (place[0], place[-1]) == pytest.approx((1 / 12, 11 / 12))
