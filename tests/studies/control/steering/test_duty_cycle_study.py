"""Duty-cycled spinning on the needle in MuJoCo."""

import math

import pytest

from studies.control.steering.duty_cycle_study import DUTY_CASES, spin, spun_curvatures

LEFT_OUT, COMPENSATED = DUTY_CASES


def test_a_needle_that_never_spins_keeps_its_curvature_and_one_that_always_does_has_none():
    assert spin(LEFT_OUT, 0.0, start_mm=20.0).share == pytest.approx(1.0, abs=1e-9)
    always = spin(LEFT_OUT, 1.0, start_mm=20.0)
    assert always.share < 0.05
    assert math.isnan(always.direction_deg)


def test_near_the_surface_the_linear_law_holds_and_at_depth_the_lag_breaks_it():
    shallow, deep = (spin(LEFT_OUT, 0.5, start_mm=depth) for depth in (20.0, 100.0))
    assert shallow.share == pytest.approx(0.5, abs=0.05)
    assert deep.share < 0.35
    assert deep.direction_deg < -30.0  # the tip comes late: the path bends to where it came from


def test_compensation_gives_the_law_back_at_depth():
    deep = spin(COMPENSATED, 0.5, start_mm=100.0)
    assert deep.share == pytest.approx(0.5, abs=0.05)
    assert abs(deep.direction_deg) < 5.0


def test_every_case_depth_and_duty_is_run_once():
    found = spun_curvatures((0.0,), start_depths_mm=(20.0,))
    assert [(one.case, one.start_mm, one.duty) for one in found] == [
        (LEFT_OUT, 20.0, 0.0),
        (COMPENSATED, 20.0, 0.0),
    ]
