"""The law of one contact site against the equations of its docstring, in the interpreter."""

import math

import numpy as np
import pytest

G, YIELD = 1e-3, 1e-3  # length of the stage, s, and presliding angle, rad


@pytest.fixture
def law(interpreted):
    return interpreted.law


def stage(law, *, axial=0.0):
    return law.Stage(G, axial, YIELD)


def memory(law, dry=0.0, turn=0.0, axial=0.0, phi=0.0, past=0.0):
    return law.Memory(dry, turn, axial, phi, past)


def slip_torque(law, row, s, old=None, axial=0.0):
    return law.slip_law(s, row, 0.0, old or memory(law), stage(law, axial=axial))


@pytest.mark.parametrize("share", [1.0, 0.2])
def test_sliding_releases_a_twist_over_a_travel_of_its_own(law, row, share):
    """Slower than it slides, a twist slips by k phi / shared of the axial rate that counts.

    In implicit stages, one of which may go into turning the presliding towards the slip.
    """
    shared, stiffness, axial, steps = 0.2, 5.0, 3.0, 40
    fields = row(shared=shared, stiffness=stiffness, axial=share)
    new = memory(law, axial=YIELD, phi=1e-4)
    for _ in range(steps):
        *_, new = law.site_law(0.0, fields, 0.0, new, stage(law, axial=axial), 0.0)
    once = 1.0 + G * stiffness * share * axial / shared
    assert 1e-4 * once ** (-steps - 1) <= new.phi <= 1e-4 * once ** (1 - steps)


CASES = {
    "power law": ({"viscous": 0.02, "exponent": 0.6}, 0.7, 0.0),
    "sticking": ({"kinetic": 0.3, "static": 0.3}, 0.4 * YIELD / G, 0.0),
    "stribeck": ({"kinetic": 0.1, "static": 0.3, "stribeck": 2.0}, 1.5, 0.0),
    "shared": ({"shared": 0.2}, 1.3, 0.9),
    "yielding tissue": ({"viscous": 0.02, "stiffness": 5.0, "time": 0.2}, 0.7, 0.0),
    "shaped": (
        {
            "viscous": 0.02,
            "kinetic": 0.1,
            "static": 0.1,
            "shaped": 1.0,
            "asymmetry": 0.3,
            "rate_low": -3.0,
        }
        | {"rate_step": 1.0, "curve_0": 1.0, "curve_1": 0.5, "curve_2": 0.2, "curve_4": -0.5},
        0.7,
        0.0,
    ),
    "after slipping": (
        {"viscous": 0.02, "kinetic": 0.1, "static": 0.1, "stiffness": 5.0, "shaped": 1.0}
        | {"contact": 1.0, "contact_scale": 0.1, "contact_step": 0.5}
        | {"contact_0": 0.3, "contact_1": -0.4, "contact_2": -0.8},
        0.7,
        0.0,
    ),
    "hardening tissue": (
        {"viscous": 0.02, "kinetic": 0.1, "static": 0.1, "stiffness": 5.0, "time": 0.2, "follows": 1.0}
        | {"contact": 7.0, "contact_scale": 0.01, "contact_step": 0.5}
        | {"contact_1": 0.4, "contact_2": 1.1, "contact_3": 1.5},
        0.7,
        0.0,
    ),
    "hardening tissue whose viscosity hardly does": (
        {"viscous": 0.02, "stiffness": 5.0, "time": 0.2, "follows": 0.3}
        | {"contact": 7.0, "contact_scale": 0.01, "contact_step": 0.5}
        | {"contact_1": 0.4, "contact_2": 1.1, "contact_3": 1.5},
        0.7,
        0.0,
    ),
    "tissue that has softened for good": (
        {"viscous": 0.02, "stiffness": 5.0, "time": 0.2, "follows": 0.3}
        | {"contact": 8.0, "contact_scale": 0.01, "contact_step": 0.5, "contact_4": -0.7},
        0.7,
        0.0,
    ),
    "kerf": ({"stiffness": 5.0, "kerf": 200.0, "backwards": 1.0, "kerf_angle": 0.05}, 0.7, 0.8),
    "all": (
        {"viscous": 0.02, "kinetic": 0.1, "static": 0.1, "shared": 0.1, "stiffness": 5.0, "time": 0.1},
        1.7,
        0.8,
    ),
}


@pytest.mark.parametrize("case", CASES)
def test_the_slope_is_the_derivative_of_the_torque(law, row, case):
    fields, omega, axial = CASES[case]
    old = memory(law, dry=2e-4, turn=1e-4, axial=-1e-4, phi=0.01, past=0.07)
    fields = row(**fields)

    def site(rate):
        return law.site_law(rate, fields, 0.0, old, stage(law, axial=axial), 0.0)

    step = 1e-6
    difference = (site(omega + step)[0] - site(omega - step)[0]) / (2 * step)
    # A central difference: its error is step^2 f''' / 6 plus eps f / step, below 1e-9 here.
    assert site(omega)[1] == pytest.approx(difference, abs=1e-8)
    assert site(omega)[1] != pytest.approx(1.01 * difference, abs=1e-8)  # 1 % off would be seen


def test_yielding_tissue_is_in_series_with_the_slip(law, row):
    """f = k phi + k tau dphi/dt and dphi/dt = omega - s, both at the end of the stage."""
    stiffness, tau, omega, old = 5.0, 0.2, 0.7, memory(law, phi=0.01)
    fields = row(viscous=0.02, kinetic=0.1, static=0.1, stiffness=stiffness, time=tau)
    torque, _, s, new = law.site_law(omega, fields, 0.0, old, stage(law), 0.0)
    rate = (new.phi - old.phi) / G
    assert rate == pytest.approx(omega - s)
    assert torque == pytest.approx(stiffness * new.phi + stiffness * tau * rate)
    assert torque == pytest.approx(slip_torque(law, fields, s, old)[0])


@pytest.mark.parametrize("contact", [7.0, 8.0], ids=["twist", "largest twist so far"])
@pytest.mark.parametrize("follows", [0.0, 0.4, 1.0])
def test_the_viscosity_goes_along_with_the_stiffness_by_a_power(law, row, contact, follows):
    """f = k (c phi + c^follows tau dphi/dt), with c of the curve, which is level here."""
    stiffness, tau, c = 5.0, 0.2, 1.7
    level = {f"contact_{i}": math.log(c) for i in range(9)}
    shape = {"contact": contact, "contact_scale": 0.01, "contact_step": 0.5, "follows": follows}
    fields = row(viscous=0.02, stiffness=stiffness, time=tau, **shape, **level)
    old = memory(law, phi=0.01, past=0.02)
    torque, _, s, new = law.site_law(0.7, fields, 0.0, old, stage(law), 0.0)
    # The last step of the iteration may leave 1e-6 of the slip rate.
    assert torque == pytest.approx(stiffness * (c * new.phi + c**follows * tau * (0.7 - s)), rel=1e-6)
    assert torque == pytest.approx(0.02 * s, rel=1e-6)


@pytest.mark.parametrize("start", [-3.0, 0.0, 0.69, 40.0])
@pytest.mark.parametrize("shape", [{}, {"exponent": 0.4}, {"kinetic": 0.1, "static": 0.1}])
def test_the_slip_does_not_depend_on_where_its_iteration_starts(law, row, shape, start):
    fields = row(viscous=0.02, stiffness=5.0, time=0.2, plateau=1e-3, **shape)
    found, known = (
        law.site_law(0.7, fields, 0.0, memory(law, phi=0.01), stage(law), at) for at in (start, 0.7)
    )
    # The last step may be 1e-7 of the slip rate; what it misses is of the order of its square.
    assert (found[0], found[2]) == pytest.approx((known[0], known[2]), rel=1e-12)
    assert found[1] == pytest.approx(known[1], rel=1e-6)  # a slope for Newton's method


@pytest.mark.parametrize("seed", range(50))
def test_friction_that_falls_faster_than_tissue_gives_way_has_a_slip_that_balances(law, row, seed):
    rng = np.random.default_rng(seed)
    kinetic, excess, stribeck, k, tau = 10 ** rng.uniform([-6, -3, -3, -3, -3], [0, 2, 0, 2, 1])
    fields = row(
        viscous=1e-4,
        kinetic=kinetic,
        static=kinetic * (1 + excess),
        stribeck=stribeck,
        stiffness=k,
        time=tau,
    )
    omega, start = rng.normal(0.0, 10 ** rng.uniform(-4, 3, 2))
    old = memory(law, phi=0.01 * rng.normal())
    torque, slope, s, new = law.site_law(omega, fields, 0.0, old, stage(law), start)
    assert np.isfinite([torque, slope, s, *new]).all()
    elastic = k * (new.phi + tau * (omega - s))
    # 40 halvings leave 1e-12 of the bracket; where friction falls, torque changes by at most
    # kinetic excess / stribeck per rate. Rounding is that of the tissue's two parts.
    steepest = kinetic * excess / stribeck + k * (tau + G)
    assert torque == pytest.approx(elastic, abs=1e-12 * steepest * (abs(omega) + abs(start) + 1.0))
