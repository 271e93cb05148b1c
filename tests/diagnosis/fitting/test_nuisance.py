"""What every fit leaves open."""

import math
from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import RIG, prepared, trial, turns

from diagnosis.criteria.fitting import SCATTER
from diagnosis.criteria.prepare import START_SPREAD_DEG
from diagnosis.fitting.nuisance import (
    CONVENTIONS,
    PRIOR_SIGMA,
    clock_starts_of,
    late_starts_of,
    nuisance_of,
    prior_sigma,
    reading_jump,
    smoothing_of,
)
from diagnosis.prepare.prepared_log import PreparedLog
from diagnosis.prepare.start.late_start import LateStart
from diagnosis.replay.rig_parameters import NOMINAL, Past
from diagnosis.replay.sensing.reading_errors import ClockStart, ReadingJump, SmoothedReading

STILL = prepared(trial(turns()))
SLIDING = prepared(trial(turns(), speed=-1.0))
GROWING = replace(SLIDING, inserted_mm=90 + SLIDING.time_s)
CONSTANT, GROWS = "slip_constant_depth", "slip_growing_depth"


@pytest.mark.parametrize(
    ("trials", "slips"),
    [
        ((STILL,), set()),
        ((STILL, SLIDING), {CONSTANT}),
        ((GROWING,), {GROWS}),
        ((SLIDING, GROWING), {CONSTANT, GROWS}),
    ],
)
def test_scatter_is_open_always_and_the_rate_by_what_a_log_does(trials, slips):
    names = {e.name for e in nuisance_of(PreparedLog(rig=RIG, trials=trials))}
    assert names == set(SCATTER) | slips


def test_each_open_share_is_of_its_own_kind_of_trial():
    log = PreparedLog(rig=RIG, trials=(SLIDING, GROWING))
    shares = {e.name: e.apply(NOMINAL, 0.7) for e in nuisance_of(log) if e.name in CONVENTIONS}
    assert shares[CONSTANT] == replace(NOMINAL, material_share_constant_depth=0.7)
    assert shares[GROWS] == replace(NOMINAL, material_share_growing_depth=0.7)


def test_a_late_trial_has_a_past_of_its_own():
    late = replace(STILL, late_start=LateStart(twist_deg=20.0, rate_deg_s=0.0, unused_s=0.5))
    log = PreparedLog(rig=RIG, trials=(STILL, replace(late, name="late.csv")))
    (start,) = late_starts_of(log)
    assert start.name in {effect.name for effect in nuisance_of(log)}
    assert start.trial == "late.csv"
    assert start.reported == ()
    past = Past(trial="late.csv", turned_deg=12.0, wound_deg=-7.0)
    assert start.apply(NOMINAL, 12.0, -7.0) == replace(NOMINAL, pasts=(past,))
    unit_deg = start.parameters[0].scale
    assert prior_sigma(start) * unit_deg == START_SPREAD_DEG


def test_a_log_without_late_trials_has_no_pasts():
    assert late_starts_of(PreparedLog(rig=RIG, trials=(STILL,))) == ()


def test_everything_that_is_open_has_a_prior():
    log = PreparedLog(rig=RIG, trials=(SLIDING, GROWING))
    assert {e.name for e in nuisance_of(log)} == set(PRIOR_SIGMA)


def test_the_size_of_a_jump_is_open_without_a_prior():
    lost = ReadingJump(trial="trial_02.csv", sensor="tip_angle_deg", time_s=7.38, size=0.0)
    jump = reading_jump(lost, sigma=0.3)
    assert jump.trial == "trial_02.csv"
    assert prior_sigma(jump) == math.inf
    (size,) = jump.parameters
    assert size.to_fit(0.6) == pytest.approx(2.0)  # in sigma
    rig = jump.apply(jump.apply(NOMINAL, 1.0), 2.0)
    assert rig.jumps == (replace(lost, size=1.0), replace(lost, size=2.0))


def test_each_trial_that_was_read_has_a_time_that_a_clock_ran_before_it():
    read, unread = np.zeros(STILL.time_s.size), np.full(STILL.time_s.size, np.nan)
    both = replace(STILL, name="a", readings={"tip_angle_deg": read, "base_torque_n_mm": read})
    one = replace(STILL, name="b", readings={"tip_angle_deg": unread, "base_torque_n_mm": read})
    log = PreparedLog(rig=RIG, trials=(both, one))
    (one,) = clock_starts_of(log, "tip_angle_deg")
    assert one.trial == "a"
    assert one.apply(NOMINAL, 2.5).clock_starts == (
        ClockStart(trial="a", sensor="tip_angle_deg", before_s=2.5),
    )
    assert [own.trial for own in clock_starts_of(log, "base_torque_n_mm")] == ["a", "b"]
    assert math.isinf(prior_sigma(one))


def test_what_a_filter_left_of_smoothed_readings_is_open():
    trials = (replace(STILL, smoothed_above_hz={"tip_angle_deg": 4.0}), STILL)
    (smoothing,) = smoothing_of(PreparedLog(rig=RIG, trials=trials))
    assert smoothing.name in [e.name for e in nuisance_of(PreparedLog(rig=RIG, trials=trials))]
    assert smoothing.needs == "tip_angle_deg"
    rig = smoothing.apply(NOMINAL, 0.1, 0.9)
    known = SmoothedReading(sensor="tip_angle_deg", second_coefficient=0.1, fourth_coefficient=0.9)
    assert rig.smoothed == (known,)
    assert rig.without_sensors == NOMINAL
    assert smoothing_of(PreparedLog(rig=RIG, trials=(STILL,))) == ()
