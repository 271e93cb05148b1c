"""One fast turn three times: bounds, where they come from, and that they fail where they should."""

from dataclasses import replace

import numpy as np
import pytest

from models.needle import NITINOL
from studies.crosscheck import motion, native_needle, turn
from studies.crosscheck.turn import (
    BOUND_DEG,
    FREE_MM,
    NATIVE_BOUND_DEG,
    check_fast_turn,
    compare,
    turned,
)


def test_all_three_agree():
    checks = check_fast_turn()
    assert len(checks) == 3 * len(FREE_MM)
    for check in checks:
        assert check.passed, check


def test_damping_of_the_native_needle_that_is_one_percent_off_is_caught():
    """Negative control: its tip is then late by up to 0.3 deg."""
    good = turned(0.0)
    wrong = replace(motion.closed_form(good.run.setup), damping_n_mm_s_per_mm=1.01 * 0.01725)
    late = native_needle.tip_rad(wrong, good.run.time_s, np.radians(good.run.inputs.drive))
    ours, native, both = compare(replace(good, native_tip_deg=np.degrees(late)))
    assert ours.passed
    assert not native.passed
    assert not both.passed


@pytest.mark.parametrize("free_mm", FREE_MM)
def test_the_native_bound_is_lumping_and_steps(free_mm):
    """The leading errors of the module's docstring, from the closed form's modes."""
    _, lumping, steps = leading_errors_deg(free_mm)
    assert np.abs(lumping).max() == pytest.approx(0.0011 if free_mm == 0 else 0.0008, rel=0.1)
    assert np.abs(steps).max() == pytest.approx(0.0016 if free_mm == 0 else 0.0009, rel=0.1)
    assert np.abs(lumping).max() + np.abs(steps).max() < NATIVE_BOUND_DEG


def test_the_native_error_is_the_leading_one():
    """Poles that are too slow, and what the extrapolation leaves: -(h^2 / 2) of the second term.

    Next orders are smaller by about h times the fastest rate that matters, 5 ms 20 / s = 0.1.
    """
    time, lumping, steps = leading_errors_deg(0.0)
    turned_once = turned(0.0)
    error = turned_once.native_tip_deg - turned_once.exact_tip_deg
    found = np.interp(time, turned_once.run.time_s, error)
    assert np.abs(found - (lumping - steps)).max() < 0.2 * np.abs(found).max()


def leading_errors_deg(free_mm):
    """Times, s, and the two leading errors of the tip at these, deg."""
    case = motion.closed_form(motion.viscous_setup(free_mm=free_mm))
    p, a = case.poles_rad_s(300), case.participation(300)
    time = np.arange(0.01, 2.0, 0.01)[:, None]

    def of_both_ramps(order, power):
        """t^power times the derivative of that order of each ramp's response, deg and s."""
        starts = (np.maximum(time - start, 0.0) for start in (0.0, motion.TURN_S))
        first, second = (
            ((t > 0) * t**power * -a * p ** (order - 1) * np.exp(p * t)).sum(1) for t in starts
        )
        return 90.0 / motion.TURN_S * (first - second)

    spacing = 200.0 / native_needle.ELEMENTS
    lumping = spacing**2 * 0.01725 / (12 * NITINOL.rigidity_n_mm2) * of_both_ramps(2, 1)
    steps = 0.005**2 / 2 * (of_both_ramps(3, 1) / 3 + of_both_ramps(4, 2) / 8)
    return time[:, 0], lumping, steps


def test_the_bound_of_both_is_the_sum():
    assert compare(turned(0.0))[2].high == BOUND_DEG + NATIVE_BOUND_DEG


def test_a_turn_is_simulated_once():
    assert turn.turned(0.0) is turn.turned(0.0)
