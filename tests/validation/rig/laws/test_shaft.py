"""Springs of the shaft and of the chuck: play, slip, hardening, a permanent set."""

import pytest

from validation.rig.laws.shaft import chuck_torque, link_torque, set_growth, soft_spring


def test_the_chuck_is_a_spring_with_play_that_slips_at_its_grip(step):
    made = step(half_gap=0.01, base_compliance=0.5, grip=1.0)
    stiffness = 1 / (1 / made.chain.link[0] + 0.5)
    assert chuck_torque(made.law, made.chain, made.state, 0.005, 0.0)[0] == 0.0
    torque, slope, slipped = chuck_torque(made.law, made.chain, made.state, 0.11, 0.0)
    assert (torque, slope, slipped) == (pytest.approx(0.1 * stiffness), stiffness, 0.0)
    torque, slope, slipped = chuck_torque(made.law, made.chain, made.state, 9.01, 0.0)
    assert (torque, slope) == (1.0, 0.0)
    assert slipped == pytest.approx(9.0 - 1.0 / stiffness)


def test_a_strain_hardening_spring_adds_the_cube_of_the_strain(step):
    soft, hard = step(), step(hardening=1e4)
    one = chuck_torque(soft.law, soft.chain, soft.state, 0.4, 0.0)[0]
    other = chuck_torque(hard.law, hard.chain, hard.state, 0.4, 0.0)[0]
    strain = 0.4 / hard.chain.link_mm[0]
    assert other / one == pytest.approx(1 + 1e4 * strain**2)


@pytest.mark.parametrize("stretch", [-0.4, 1e-6, 0.02, 3.0])
def test_a_soft_spring_loses_play_and_twist_under_its_torque(stretch):
    torque, slope = soft_spring(4.0, 0.3, 0.5, stretch)
    assert torque / 4.0 + 0.3 * torque / (0.5 + abs(torque)) == pytest.approx(stretch, rel=1e-9)
    h = 1e-7
    ends = [soft_spring(4.0, 0.3, 0.5, stretch + side)[0] for side in (h, -h)]
    assert slope == pytest.approx((ends[0] - ends[1]) / (2 * h), rel=1e-5)


def test_a_soft_spring_is_stiff_far_out_and_soft_about_zero():
    assert soft_spring(4.0, 0.3, 0.5, 100.0)[1] == pytest.approx(4.0, rel=1e-4)
    assert soft_spring(4.0, 0.3, 0.5, 0.0) == (0.0, pytest.approx(1 / (1 / 4.0 + 0.3 / 0.5)))


def test_a_link_yields_along_its_back_torque(step):
    """Beyond the yield torque the slope is k s / (1 + s); the set takes up the rest."""
    made = step(yield_torque=0.2, yield_slope=0.5)
    k = made.chain.link[2]
    twist = 3 * 0.2 / k
    torque, slope = link_torque(made.law, made.chain, made.state, 2, twist)
    assert slope == pytest.approx(k / 3)
    assert torque == pytest.approx(0.2 + 0.4 / 3)
    made.state.set_twist[2] = set_growth(made.law, k, twist, 0.0)
    assert k * (twist - made.state.set_twist[2]) == pytest.approx(torque)
    assert link_torque(made.law, made.chain, made.state, 2, 0.9 * twist)[1] == pytest.approx(k)
    assert set_growth(made.law, k, 0.9 * twist, made.state.set_twist[2]) == 0.0


def test_a_shaft_that_does_not_yield_takes_no_set(step):
    made = step()
    assert set_growth(made.law, 5.0, 100.0, 0.0) == 0.0
