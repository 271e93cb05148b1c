"""Readings far off the best explanation are left out, where only that explains a log."""

import math
from dataclasses import replace

import numpy as np
from diagnosis_fixtures import log_of, start_of_search

from diagnosis.log.trial import Trial
from diagnosis.prepare.noise.noise_colour import NoiseColour
from diagnosis.replay.rig_parameters import NOMINAL, RigParameters
from diagnosis.selection.record import Decision
from diagnosis.selection.stages.nominal_rig import nominal_rig
from diagnosis.selection.stages.sensors.outliers_left import (
    STAGE,
    outliers_and_more,
    outliers_beside_the_best,
)
from diagnosis.workers import Workers

TIP, TORQUE = "tip_angle_deg", "base_torque_n_mm"


def off(log, rows, sigmas, column=TORQUE, sigma=0.01):
    (one,) = log.trials
    table = one.table.copy()
    table.loc[rows, column] += sigma * np.asarray(sigmas, float)
    return replace(log, trials=(Trial(name=one.name, table=table),))


def searched(log):
    state = nominal_rig(start_of_search(log, effects=()), Workers())
    return state, outliers_beside_the_best(state, Workers())


def decisions(state):
    return [e.decision for e in state.record if e.stage == STAGE and e.score is None]


def test_outliers_beside_the_best_are_left_out_and_told():
    """Four in a row, of two pairs, and one alone."""
    log = off(log_of(NOMINAL, seconds=12.0), [700, 701, 702, 703, 1100], [17, 16, 11, 10, -30])
    before, after = searched(log)
    assert not before.best.floor.reached
    assert after.best.floor.reached
    assert decisions(after) == [Decision.KEPT]
    (told,) = after.left_out
    np.testing.assert_allclose(told.times_s, [7.0, 7.01, 7.02, 7.03, 11.0])
    assert (told.sensor, told.samples) == (TORQUE, 1200)
    (trial,) = after.problem.log.trials
    assert np.isnan(trial.readings[TORQUE]).sum() == 5
    assert after.best.fit.by_trial[0].size == before.best.fit.by_trial[0].size - 5


def test_a_trial_without_readings_is_no_hindrance():
    log = off(log_of(NOMINAL, seconds=12.0), [700, 701, 702, 703, 1100], [17, 16, 11, 10, -30])
    (one,) = log.trials
    blind = Trial(name="trial_02.csv", table=one.table.drop(columns=[TIP, TORQUE]))
    _, after = searched(replace(log, trials=(one, blind)))
    assert [len(own.times_s) for own in after.left_out] == [5]


def test_a_log_that_is_explained_is_left_alone():
    before, after = searched(log_of(NOMINAL, seconds=12.0))
    assert after.problem is before.problem
    assert after.left_out == ()
    assert decisions(after) == []


def test_what_an_effect_leaves_is_no_outlier():
    before, after = searched(log_of(RigParameters(kinetic_n_mm_per_mm=0.001), seconds=12.0))
    assert not before.best.floor.reached
    assert after.left_out == ()


def test_waves_of_slow_noise_are_worth_no_fit_if_little_is_left_without_them():
    """They stick out by 8 sigma, of which a reading tells most of the next; the tip is off by 1.2."""
    share = 0.97
    sigma = 0.01 / math.sqrt(1.0 - share)
    log = off(log_of(NOMINAL, seconds=24.0), slice(None), 30.0, column=TIP)
    for start in range(100, 1150, 150):
        log = off(log, range(start, start + 9), 8.0 * np.hanning(11)[1:-1], sigma=sigma)
    state = nominal_rig(start_of_search(log, effects=()), Workers())
    noise, slow = state.problem.noise, NoiseColour.of(share=share, correlation_time_s=0.1)
    noise = replace(noise, sigma={**noise.sigma, TORQUE: sigma}, colour={TORQUE: slow})
    before = state.renoised(noise)
    assert decisions(outliers_beside_the_best(before, Workers())) == []
    white = replace(noise, colour={})
    assert decisions(outliers_beside_the_best(state.renoised(white), Workers())) == [Decision.DROPPED]


def test_outliers_that_do_not_explain_the_log_stay_in_it():
    """A step of the reading besides, of 0.3 sigma."""
    log = off(log_of(NOMINAL, seconds=12.0), [1100], [-60])
    log = off(log, slice(400, None), 0.8)
    before, after = searched(log)
    assert after.problem is before.problem
    assert after.left_out == ()
    assert decisions(after) == [Decision.DROPPED]


def test_outliers_beside_another_imperfection_are_left_out_if_both_explain_the_log(monkeypatch):
    """A step of the reading besides: what allows for it is asked once more, without the outliers."""
    log = off(log_of(NOMINAL, seconds=12.0), [700, 1100], [-60, 40])
    log = off(log, slice(400, None), 0.8)
    state = nominal_rig(start_of_search(log, effects=()), Workers())
    asked = []

    def useless(state, workers):
        asked.append(state)
        return state

    def repairing(state, workers):
        asked.append(state)
        (trial,) = state.problem.log.trials
        read = {**trial.readings, TORQUE: trial.readings[TORQUE] - 0.008 * (trial.time_s >= 4.0)}
        log = replace(state.problem.log, trials=(replace(trial, readings=read),))
        problem = replace(state.problem, log=log)
        return nominal_rig(replace(state, problem=problem, candidates=(), checked=None), Workers())

    kept = outliers_and_more((useless, repairing))(state, Workers())
    assert [one.left_out[0].times_s.tolist() for one in asked] == [[7.0, 11.0], [7.0, 11.0]]
    assert kept.best.floor.reached
    assert decisions(kept) == [Decision.KEPT]
    dropped = outliers_and_more((useless,))(state, Workers())
    assert dropped.problem is state.problem
    assert dropped.left_out == ()
