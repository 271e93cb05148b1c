"""What a log covers, and what is missing of it."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import RIG, turns
from free_forms import CURVE, DAMPING, covered, covered_by, one_trial

from diagnosis.freeform.ranges import LEAST_PAST_S, LONGEST_PAST_S, ranges_of, values_of
from diagnosis.replay.variables import Variable

ANGLE = turns()


def test_what_never_changes_is_no_variable():
    ends = covered(ANGLE, tip=ANGLE).ends
    assert {Variable.TIME, Variable.BASE_ANGLE, Variable.RATE, Variable.DIRECTION} <= set(ends)
    # At rest at one depth, and a nominal rig that reads 0 throughout.
    absent = {Variable.AXIAL_SPEED, Variable.DEPTH, Variable.TIP_ANGLE, Variable.TORQUE}
    assert not absent & set(ends)


def test_what_a_variable_covers_is_all_but_a_few_samples():
    slow = np.linspace(0.0, 50.0, 1000)
    ends = covered(slow, tip=slow).ends
    assert ends[Variable.BASE_ANGLE] == pytest.approx((0.002 * 50, 0.998 * 50), abs=0.1)
    assert ends[Variable.TIME] == pytest.approx((0.02, 9.97), abs=0.02)
    assert ends[Variable.PAST] == (LEAST_PAST_S, LONGEST_PAST_S)


def test_of_trials_that_last_alike_a_share_is_a_time():
    def ends(*lasting):
        angles = [ANGLE[:n] for n in lasting]
        return covered_by([(a, a, (a, np.zeros(a.size))) for a in angles]).ends

    assert Variable.TRIAL_SHARE not in covered(ANGLE, tip=ANGLE).ends
    assert Variable.TRIAL_SHARE not in ends(400, 400)
    assert ends(400, 300)[Variable.TRIAL_SHARE] == pytest.approx((0.0, 1.0), abs=0.01)


def test_a_base_that_turns_too_little_is_no_variable():
    assert Variable.BASE_ANGLE not in covered(0.1 * ANGLE, tip=ANGLE).ends


def test_what_is_missing_is_the_residual_of_each_sensor_that_was_read():
    off = np.random.default_rng(7).normal(0, 3.0, ANGLE.size)
    off[100:200] = np.nan
    ranges = covered(ANGLE, tip=ANGLE + off, seen=(ANGLE, np.zeros(ANGLE.size)))
    assert ranges.missing == pytest.approx({"tip_angle_deg": np.sqrt(np.nanmean(off**2))})
    np.testing.assert_allclose(ranges.left["tip_angle_deg"][0], off, atol=1e-9)
    assert "base_torque_n_mm" not in ranges.left


def test_what_the_needle_does_is_that_of_the_nominal_rig():
    problem, nominal = one_trial(ANGLE, tip=ANGLE, seen=(0.5 * ANGLE, 0.01 * ANGLE))
    one = problem.log.trials[0]
    np.testing.assert_array_equal(values_of(Variable.TIP_ANGLE, one, nominal[0]), 0.5 * ANGLE)
    assert values_of(Variable.BASE_ANGLE, one, nominal[0]).size == one.schedule.time_s.size
    ranges = ranges_of(problem, nominal)
    assert ranges.ends[Variable.TORQUE] == pytest.approx((-0.3, 0.9), abs=0.01)
    assert ranges.library is problem.library
    assert ranges.damping_n_mm_s_per_mm == DAMPING


def test_the_shaft_slips_fastest_where_it_enters():
    """The free length is twisted by torque * length / rigidity; half as much torque, half the twist."""
    seen = 0.5 * ANGLE, np.radians(0.5 * ANGLE) * RIG.rigidity_n_mm2 / 100.0
    problem, nominal = one_trial(ANGLE, tip=ANGLE, torque=seen[1], seen=seen)
    free_mm = float(problem.log.trials[0].free_mm[0])
    base = covered(ANGLE, tip=ANGLE).fastest_slip_rad_s
    assert base == pytest.approx(np.radians(np.abs(np.diff(ANGLE)).max()) / 0.01, rel=0.05)
    twisted = 1.0 - 0.5 * free_mm / 100.0
    assert ranges_of(problem, nominal).fastest_slip_rad_s == pytest.approx(twisted * base, rel=1e-3)


def test_curves_are_finer_only_where_laws_are_detailed():
    angle = turns(6.0)
    ranges = covered(angle, tip=angle)
    assert ranges.in_detail(CURVE) is CURVE
    finer = replace(ranges, detail=1).in_detail(CURVE)
    assert finer.places.size == 2 * CURVE.places.size - 1
