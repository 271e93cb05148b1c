"""Drift of the torque sensor, allowed for where nothing else explains a log."""

from dataclasses import replace
from types import SimpleNamespace

import pytest
from diagnosis_fixtures import log_of, log_with, scored, start_of_search

from diagnosis.criteria import CONTENDING, DRIFT_RANGE_SIGMA, MOST_QUIETENED, NEAR_FLOOR
from diagnosis.fitting.fit import fit_effects
from diagnosis.log.trial import Trial
from diagnosis.replay.rig_parameters import NOMINAL, RigParameters
from diagnosis.selection.candidate import candidate
from diagnosis.selection.record import Decision
from diagnosis.selection.scoring.drift_evidence import noise_of_a_reading_n_mm, widest_drift
from diagnosis.selection.stages import stage
from diagnosis.selection.stages.nominal_rig import nominal_rig
from diagnosis.selection.stages.sensors import torque_drift
from diagnosis.selection.stages.sensors.torque_drift import (
    STAGE,
    drift_of_the_torque_sensor,
    drift_or_offset,
)
from diagnosis.selection.stages.single_effects import single_effects
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
    assert after.problem.noise.torque_drift_n_mm > 0
    assert Decision.KEPT in [e.decision for e in after.record if e.stage == STAGE]


def jumped(size_sigma):
    """The same with a torque that jumps by so many sigma in the middle, and stays off."""
    log = log_of(NOMINAL, seconds=14.0)
    (one,) = log.trials
    table = one.table.copy()
    table.loc[len(table) // 2 :, "base_torque_n_mm"] += size_sigma * 0.015
    return replace(log, trials=(Trial(name=one.name, table=table),))


@pytest.mark.parametrize("size_sigma", [0.6, 2.0])
def test_one_jump_is_no_drift(size_sigma):
    """A drift would bring it to the noise; of one that is a line it is the other way round."""
    before, after = searched(jumped(size_sigma))
    assert not before.best.floor.reached
    assert after.problem is before.problem
    (entry,) = [e for e in after.record if e.stage == STAGE]
    assert (entry.decision, "jump" in entry.reason) == (Decision.DROPPED, True)


@pytest.mark.parametrize(
    ("names", "decision"),
    [
        (("tip_drag",), Decision.KEPT),
        (("tip_drag", "torque_bias"), Decision.KEPT),
        (("tip_drag", "coulomb_friction"), Decision.DROPPED),
    ],
    ids=["one effect", "an offset beside it", "two effects"],
)
def test_a_drift_stands_beside_one_effect_at_most(monkeypatch, names, decision):
    """All of them leave nothing but noise beside the drift."""
    _, drifting = searched(drifted(3.5))
    found = replace(drifting, candidates=(candidate(fit_effects(drifting.problem, names)),))
    monkeypatch.setattr(torque_drift, "_searched_again", lambda *_: found)
    monkeypatch.setattr(torque_drift, "_promises", lambda *_: True)
    state = nominal_rig(start_of_search(drifted(3.5), effects=()), Workers())
    after = drift_of_the_torque_sensor(state, Workers())
    kept = after.problem.noise.torque_drift_n_mm > 0
    assert kept == (decision is Decision.KEPT)


def test_nothing_is_searched_anew_where_drift_brings_no_explanation_near(monkeypatch):
    monkeypatch.setattr(torque_drift, "_promises", lambda *_: True)
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

    def in_noise(one, *_):
        return replace(one, fit=replace(one.fit, cost=left[one.names[0]]))

    monkeypatch.setattr(torque_drift, "in_noise", in_noise)
    state = start_of_search(drifted(3.5), effects=())
    pairs = (scored(["tip_drag", "torque_bias"], 2.0), scored(["torque_bias", "tip_drag"], 1.0))
    singles = [scored([name], score) for name, score in (("stiction", 0.0), ("tip_drag", 9.0))]
    monkeypatch.setattr(type(state), "renoised", lambda own, noise: own)
    state = replace(state, pairs=pairs, singles=tuple(singles))
    torque_drift._searched_again(state, widest_drift(state.problem), Workers())
    enough = 100.0 + CONTENDING
    assert asked == [(("tip_drag",), enough), (("torque_bias", "tip_drag"), enough)]


def test_pairs_with_the_leading_effect_that_a_drift_may_have_hidden_are_screened(monkeypatch):
    asked = []

    def screen_all(_, calls, __):
        asked.extend((base.names, name) for _, base, name in calls)
        return [], ()

    monkeypatch.setattr(torque_drift, "screen_all", screen_all)
    monkeypatch.setattr(torque_drift, "in_noise", lambda one, *_: one)
    monkeypatch.setattr(torque_drift, "fitted_again", lambda *_: _)
    state = start_of_search(drifted(3.5), effects=("tip_drag", "stiction", "torque_bias"))
    monkeypatch.setattr(type(state), "renoised", lambda own, noise: own)
    state = replace(state, singles=(scored(["stiction"], 5.0), scored(["tip_drag"], 1.0)))
    torque_drift._searched_again(state, widest_drift(state.problem), Workers())
    assert asked == [(("tip_drag",), "stiction"), (("tip_drag",), "torque_bias")]


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
    assert bool(after.problem.noise.torque_drift_n_mm) is explained
    assert after.best.floor.reached is explained


@pytest.mark.parametrize(
    ("claimed", "told"), [(0.5, 1.0), (2.0, 2.0), (10.0 * MOST_QUIETENED, MOST_QUIETENED)]
)
def test_a_filter_takes_off_noise_but_not_off_a_drift(claimed, told):
    sensors = SimpleNamespace(base_torque_noise_n_mm=claimed)
    log = SimpleNamespace(rig=SimpleNamespace(sensors=sensors), means_of=4)
    problem = SimpleNamespace(log=log, noise={"base_torque_n_mm": 1.0})
    assert noise_of_a_reading_n_mm(problem) == pytest.approx(2 * told)


def moved(*each):
    """Nominal rigs, the torque of each off by an offset and a line between two sizes, in sigma."""
    trials = []
    for offset, first, last in each:
        (one,) = log_of(NOMINAL, seconds=10.0, seed=len(trials)).trials
        table = one.table.copy()
        share = table["time_s"] / table["time_s"].iloc[-1]
        table["base_torque_n_mm"] += 0.01 * (offset + first + (last - first) * share)
        trials.append(Trial(name=f"trial_{len(trials) + 1:02d}.csv", table=table))
    return log_with(*trials)


def compared(log):
    """What the search of a log with the offset of the torque sensor comes to, drift or not."""
    state = start_of_search(log, effects=("torque_bias",))
    for step in (nominal_rig, single_effects, drift_of_the_torque_sensor, drift_or_offset):
        state = step(state, Workers())
    return state


def test_a_constant_offset_is_an_effect_of_the_library_and_no_drift():
    after = compared(moved((1.5, 0, 0), (1.5, 0, 0)))
    assert after.best.names == ("torque_bias",)
    assert after.problem.noise.torque_drift_n_mm == 0.0
    assert after.open_effects == ()


def test_a_drift_that_is_zeroed_before_each_trial_is_no_offset():
    after = compared(moved((0, 0, 1.5), (0, 0, 1.6)))
    assert after.best.names == ()
    assert after.problem.noise.torque_drift_n_mm > 0.0
    assert after.open_effects == ()


def test_an_offset_beside_a_drift_that_is_zeroed_is_told_from_it():
    after = compared(moved((2.5, 0, 1.5), (2.5, 0, -1.4), (2.5, 0, 1.6)))
    assert after.best.names == ("torque_bias",)
    assert after.problem.noise.torque_zeroed


def test_a_drift_that_goes_on_from_zero_is_no_offset():
    after = compared(moved((0, 0, 2), (0, 2, 4)))
    assert after.best.names == ()
    assert after.open_effects == ()


def test_a_drift_that_begins_off_zero_in_every_trial_may_hide_an_offset():
    after = compared(moved((3, 0, 2), (3, 2, 4)))
    assert after.best.names == ()
    assert after.open_effects == ("torque_bias",)


@pytest.mark.parametrize(("share", "kept"), [(0.0, True), (3.5, False)], ids=["time", "axial speed"])
def test_what_follows_the_axial_speed_is_no_drift(share, kept):
    """The needle slides in the second half; what the speed adds is as large as the drift."""
    log = drifted(3.5 - share)
    table = log.trials[0].table
    sliding = (table["time_s"] > 0.5 * table["time_s"].max()).to_numpy(float)
    table["speed_mm_s"] = 2.0 * sliding
    table["base_torque_n_mm"] += share * 0.015 * sliding
    _, after = searched(log)
    assert (after.problem.noise.torque_drift_n_mm > 0) == kept
