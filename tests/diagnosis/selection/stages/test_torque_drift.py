"""Drift of the torque sensor, allowed for where nothing else explains a log."""

from dataclasses import replace
from types import SimpleNamespace

import pytest
from diagnosis_fixtures import log_of, scored, start_of_search

from diagnosis.criteria import (
    CONTENDING,
    DRIFT_RANGE_SIGMA,
    DRIFT_SIZE_SIGMA,
    MOST_QUIETENED,
    NEAR_FLOOR,
)
from diagnosis.log.trial import Trial
from diagnosis.replay.rig_parameters import NOMINAL, RigParameters
from diagnosis.selection.record import Decision
from diagnosis.selection.stages import stage, torque_drift
from diagnosis.selection.stages.nominal_rig import nominal_rig
from diagnosis.selection.stages.torque_drift import STAGE, drift_of_the_torque_sensor
from diagnosis.workers import Workers


def drifted(range_sigma):
    """A nominal rig whose torque drifts by a line of so many sigma (0.015 N mm)."""
    log = log_of(NOMINAL, seconds=14.0)
    (one,) = log.trials
    table = one.table.copy()
    table["base_torque_n_mm"] += range_sigma * 0.015 * table["time_s"] / table["time_s"].iloc[-1]
    return replace(log, trials=(Trial(name=one.name, table=table),))


def searched(log):
    """The nominal rig alone, then with drift if that is needed."""
    state = nominal_rig(start_of_search(log, effects=()), Workers())
    return state, drift_of_the_torque_sensor(state, Workers())


def test_a_log_that_is_explained_is_left_alone():
    before, after = searched(drifted(0.0))
    assert (after.problem, after.candidates) == (before.problem, before.candidates)
    assert after.record == before.record


def test_a_drift_that_a_sensor_may_have_explains_a_log():
    before, after = searched(drifted(3.5))
    assert not before.best.floor.reached
    assert after.best.floor.reached
    assert after.problem.log.trials[0].torque_drift_sigma > 0
    assert Decision.KEPT in [e.decision for e in after.record if e.stage == STAGE]


def test_nothing_is_searched_anew_where_drift_brings_no_explanation_near(monkeypatch):
    monkeypatch.setattr(torque_drift, "_promises", lambda problem, one: True)
    dry = log_of(RigParameters(kinetic_n_mm_per_mm=0.001), speed=-1.0, seconds=8.0)
    state = nominal_rig(start_of_search(dry, effects=()), Workers())
    after = drift_of_the_torque_sensor(state, Workers())
    assert after.problem is state.problem
    assert [e.decision for e in after.record if e.stage == STAGE] == [Decision.DROPPED]


def test_sets_that_lead_are_fitted_once_and_those_far_behind_are_not(monkeypatch):
    asked = []

    def fit_all(_, calls, __):
        asked.extend((call[1], call[3]) for call in calls if len(call) > 2)
        return [], ()

    left = {"torque_bias": 100.0, "tip_drag": 150.0, "stiction": 1.01 * NEAR_FLOOR * 100.0}
    monkeypatch.setattr(stage, "fit_all", fit_all)
    monkeypatch.setattr(torque_drift, "_cost_with_drift", lambda _, one: left[one.names[0]])
    state = start_of_search(drifted(3.5), effects=())
    pairs = (scored(["tip_drag", "torque_bias"], 2.0), scored(["torque_bias", "tip_drag"], 1.0))
    singles = [scored([name], score) for name, score in (("stiction", 0.0), ("tip_drag", 9.0))]
    state = replace(state, pairs=pairs, singles=tuple(singles))
    torque_drift._refitted(state, torque_drift._drifting(state), Workers())
    enough = 100.0 + CONTENDING
    assert asked == [(("tip_drag",), enough), (("torque_bias", "tip_drag"), enough)]


def test_a_drift_of_no_working_sensor_explains_nothing():
    before, after = searched(drifted(4 * DRIFT_RANGE_SIGMA))
    assert after.problem is before.problem
    assert [e.decision for e in after.record if e.stage == STAGE] == [Decision.DROPPED]


@pytest.mark.parametrize(("means_of", "explained"), [(1, False), (9, True)])
def test_a_drift_is_as_large_beside_the_noise_of_a_reading_that_means_have_quietened(
    means_of, explained
):
    """12 sigma of means of nine readings are 4 sigma of one."""
    log = replace(drifted(2.0 * DRIFT_RANGE_SIGMA), means_of=means_of)
    _, after = searched(log)
    assert bool(after.problem.log.trials[0].torque_drift_sigma) is explained
    assert after.best.floor.reached is explained


@pytest.mark.parametrize(
    ("claimed", "told"), [(0.5, 1.0), (2.0, 2.0), (10.0 * MOST_QUIETENED, MOST_QUIETENED)]
)
def test_a_filter_takes_off_noise_but_not_off_a_drift(claimed, told):
    sensors = SimpleNamespace(base_torque_noise_n_mm=claimed)
    log = SimpleNamespace(rig=SimpleNamespace(sensors=sensors), means_of=4)
    problem = SimpleNamespace(log=log, noise={"base_torque_n_mm": 1.0})
    assert torque_drift._size_n_mm(problem) == pytest.approx(2 * told * DRIFT_SIZE_SIGMA)


def test_a_constant_offset_is_an_effect_of_the_library_and_no_drift():
    log = log_of(NOMINAL, seconds=14.0)
    (one,) = log.trials
    raised = one.table.assign(base_torque_n_mm=one.table["base_torque_n_mm"] + 1.5 * 0.015)
    log = replace(log, trials=(Trial(name=one.name, table=raised),))
    for effects, named in ((("torque_bias",), ("torque_bias",)), ((), ())):
        state = nominal_rig(start_of_search(log, effects=effects), Workers())
        assert not state.best.floor.reached
        after = drift_of_the_torque_sensor(state, Workers())
        assert after.best.names == named
        assert (after.problem is state.problem) is bool(named)
