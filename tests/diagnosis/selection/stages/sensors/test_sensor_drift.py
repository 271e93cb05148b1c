"""Drift of a sensor, allowed for where nothing else explains a log."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import log_of, scored, start_of_search
from drifting_logs import SIZES, STAGES, drifted, jumped, moved, off, searched

from diagnosis.criteria.selection import CONTENDING, DRIFT_RANGE_SIGMA, NEAR_FLOOR
from diagnosis.fitting.fit import fit_effects
from diagnosis.log.trial import SENSORS, TIP, TORQUE, Trial
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.selection.candidate import candidate
from diagnosis.selection.record import Decision
from diagnosis.selection.scoring.drift_evidence import wide_drifts
from diagnosis.selection.stages import stage
from diagnosis.selection.stages.nominal_rig import nominal_rig
from diagnosis.selection.stages.sensors import sensor_drift
from diagnosis.selection.stages.sensors.drift_or_offset import OFFSETS
from diagnosis.selection.stages.sensors.sensor_drift import (
    OF_TIP,
    OF_TORQUE,
    drift_of_the_tip_sensor,
    drift_of_the_torque_sensor,
)
from diagnosis.workers import Workers

NAMES = {TORQUE: OF_TORQUE, TIP: OF_TIP}
BESIDE = {TORQUE: "tip_drag", TIP: "base_compliance"}  # effects that a drift does not tell


def said(state, sensor):
    """Entries of the record about the drift of a sensor."""
    return [e for e in state.record if e.stage == NAMES[sensor]]


@pytest.mark.parametrize("sensor", SENSORS)
def test_a_log_that_is_explained_is_left_alone(sensor):
    before, after = searched(drifted(0.0), sensor)
    assert (after.problem, after.candidates) == (before.problem, before.candidates)
    assert after.record == before.record


@pytest.mark.parametrize("sensor", SENSORS)
def test_a_drift_that_a_sensor_may_have_explains_a_log(sensor):
    before, after = searched(drifted(3.5, sensor), sensor)
    assert not before.best.floor.reached
    assert after.best.floor.reached
    assert [*after.problem.noise.drifts] == [sensor]
    assert Decision.KEPT in [e.decision for e in said(after, sensor)]


def test_drifts_of_both_sensors_at_once_explain_nothing():
    log = off(drifted(3.5, TORQUE), TIP, lambda share: 3.5 * np.sin(2 * share))
    before = nominal_rig(start_of_search(log, effects=()), Workers())
    after = drift_of_the_tip_sensor(drift_of_the_torque_sensor(before, Workers()), Workers())
    assert after.problem is before.problem


def test_where_slopes_promise_too_little_beside_a_drift_nothing_is_fitted(monkeypatch):
    """A drift takes off much of what dry friction leaves, and never comes near the noise."""
    monkeypatch.setattr(sensor_drift, "promises", lambda *_: True)
    monkeypatch.setattr(sensor_drift, "_searched_again", pytest.fail)
    dry = log_of(RigParameters(kinetic_n_mm_per_mm=0.002), speed=-1.0, seconds=8.0)
    state = nominal_rig(start_of_search(dry, effects=()), Workers())
    after = drift_of_the_torque_sensor(state, Workers())
    assert after.record[-1].reason == "no explanation comes near the noise with it"


def test_a_drift_of_one_sensor_is_none_of_the_other():
    for sensor, other in ((TORQUE, TIP), (TIP, TORQUE)):
        before, after = searched(drifted(3.5, other), sensor)
        assert not before.best.floor.reached
        assert after.problem is before.problem


@pytest.mark.parametrize("sensor", SENSORS)
@pytest.mark.parametrize("size_sigma", [0.6, 2.0])
def test_one_jump_is_no_drift(size_sigma, sensor):
    """A drift would bring it to the noise; of one that is a line it is the other way round."""
    before, after = searched(jumped(size_sigma, sensor), sensor)
    assert not before.best.floor.reached
    assert after.problem is before.problem
    (entry,) = said(after, sensor)
    assert (entry.decision, "jump" in entry.reason) == (Decision.DROPPED, True)


@pytest.mark.parametrize("sensor", SENSORS)
@pytest.mark.parametrize(
    ("names", "decision"),
    [
        (("an effect",), Decision.KEPT),
        (("an effect", "its offset"), Decision.KEPT),
        (("an effect", "coulomb_friction"), Decision.DROPPED),
        (("an effect", "of the other sensor"), Decision.KEPT),
    ],
    ids=["one effect", "an offset beside it", "two effects", "one of the other sensor"],
)
def test_a_drift_stands_beside_one_effect_at_most(monkeypatch, names, decision, sensor):
    """All of them leave nothing but noise beside the drift."""
    (other,) = {*SENSORS} - {sensor}
    said = {"an effect": BESIDE[sensor], "its offset": OFFSETS[sensor]}
    said["of the other sensor"] = OFFSETS[other]
    names = tuple(said.get(name, name) for name in names)
    _, drifting = searched(drifted(3.5, sensor), sensor)
    found = replace(drifting, candidates=(candidate(fit_effects(drifting.problem, names)),))
    monkeypatch.setattr(sensor_drift, "_searched_again", lambda *_: found)
    monkeypatch.setattr(sensor_drift, "promises", lambda *_: True)
    state = nominal_rig(start_of_search(drifted(3.5, sensor), effects=()), Workers())
    after = STAGES[sensor](state, Workers())
    kept = bool(after.problem.noise.drifts)
    assert kept == (decision is Decision.KEPT)


@pytest.mark.parametrize("sensor", SENSORS)
def test_nothing_is_searched_anew_where_drift_brings_no_explanation_near(monkeypatch, sensor):
    monkeypatch.setattr(sensor_drift, "promises", lambda *_: True)
    dry = log_of(RigParameters(kinetic_n_mm_per_mm=0.001), speed=-1.0, seconds=8.0)
    state = nominal_rig(start_of_search(dry, effects=()), Workers())
    after = STAGES[sensor](state, Workers())
    assert after.problem is state.problem
    assert [e.decision for e in said(after, sensor)] == [Decision.DROPPED]


def test_sets_that_lead_are_fitted_once_and_those_far_behind_are_not(monkeypatch):
    asked = []

    def fit_all(_, calls, __):
        asked.extend((call[1], call[3]) for call in calls if len(call) > 2)
        return [], ()

    left = {"torque_bias": 100.0, "tip_drag": 150.0, "stiction": 1.01 * NEAR_FLOOR * 100.0}
    monkeypatch.setattr(stage, "fit_all", fit_all)

    def in_noise(one, *_):
        return replace(one, fit=replace(one.fit, cost=left[one.names[0]]))

    monkeypatch.setattr(sensor_drift, "in_noise", in_noise)
    state = start_of_search(drifted(3.5), effects=())
    pairs = (scored(["tip_drag", "torque_bias"], 2.0), scored(["torque_bias", "tip_drag"], 1.0))
    singles = [scored([name], score) for name, score in (("stiction", 0.0), ("tip_drag", 9.0))]
    monkeypatch.setattr(type(state), "renoised", lambda own, noise: own)
    state = replace(state, pairs=pairs, singles=tuple(singles))
    sensor_drift._searched_again(state, TORQUE, wide_drifts(state.problem, TORQUE)[0], Workers())
    enough = 100.0 + CONTENDING
    assert asked == [(("tip_drag",), enough), (("torque_bias", "tip_drag"), enough)]


def test_pairs_with_the_leading_effect_that_a_drift_may_have_hidden_are_screened(monkeypatch):
    asked = []

    def screen_all(_, calls, __):
        asked.extend((base.names, name) for _, base, name in calls)
        return [], ()

    monkeypatch.setattr(sensor_drift, "screen_all", screen_all)
    monkeypatch.setattr(sensor_drift, "in_noise", lambda one, *_: one)
    monkeypatch.setattr(
        sensor_drift, "fitted_again", lambda _, start, *__: start.adding(([scored([], 1.0)], ()))
    )
    state = start_of_search(drifted(3.5), effects=("tip_drag", "stiction", "torque_bias"))
    monkeypatch.setattr(type(state), "renoised", lambda own, noise: own)
    state = replace(state, singles=(scored(["stiction"], 5.0), scored(["tip_drag"], 1.0)))
    sensor_drift._searched_again(state, TORQUE, wide_drifts(state.problem, TORQUE)[0], Workers())
    assert asked == [(("tip_drag",), "stiction"), (("tip_drag",), "torque_bias")]


@pytest.mark.parametrize("sensor", SENSORS)
def test_a_drift_of_no_working_sensor_explains_nothing(sensor):
    before, after = searched(drifted(4 * DRIFT_RANGE_SIGMA, sensor), sensor)
    assert after.problem is before.problem
    assert [e.decision for e in said(after, sensor)] == [Decision.DROPPED]


@pytest.mark.parametrize(("means_of", "explained"), [(1, False), (9, True)])
def test_a_drift_is_as_large_beside_the_noise_of_a_reading_that_means_have_quietened(
    means_of, explained
):
    """36 sigma of means of nine readings are 12 sigma of one."""
    log = replace(drifted(1.6 * DRIFT_RANGE_SIGMA), means_of=means_of)
    _, after = searched(log)
    assert bool(after.problem.noise.drifts) is explained
    assert after.best.floor.reached is explained


@pytest.mark.parametrize("sensor", SENSORS)
@pytest.mark.parametrize(("last", "kept"), [(-8, True), (8, False)], ids=["to either side", "alike"])
def test_a_law_over_time_that_is_larger_than_a_drift_stays_unknown(last, kept, sensor):
    """One line of 8 sigma in every trial is a law; lines to either side are none."""
    _, after = searched(moved((0, 0, 8), (0, 0, last), sensor=sensor), sensor)
    assert bool(after.problem.noise.drifts) == kept
    assert after.best.floor.reached == kept


def test_of_a_sensor_that_was_not_read_no_drift_is_asked():
    (one,) = drifted(3.5).trials
    blind = replace(drifted(3.5), trials=(Trial(name=one.name, table=one.table.drop(columns=[TIP])),))
    before, after = searched(blind, TIP)
    assert after.problem is before.problem
    assert said(after, TIP) == []


@pytest.mark.parametrize("sensor", SENSORS)
@pytest.mark.parametrize(("share", "kept"), [(0.0, True), (3.5, False)], ids=["time", "axial speed"])
def test_what_follows_the_axial_speed_is_no_drift(share, kept, sensor):
    """The needle slides in the second half; what the speed adds is as large as the drift."""
    log = drifted(3.5 - share, sensor)
    table = log.trials[0].table
    sliding = (table["time_s"] > 0.5 * table["time_s"].max()).to_numpy(float)
    table["speed_mm_s"] = 2.0 * sliding
    table[sensor] += share * SIZES[sensor] * sliding
    _, after = searched(log, sensor)
    assert bool(after.problem.noise.drifts) == kept


def test_the_best_beside_a_drift_is_fitted_without_what_it_had_taken_up():
    """A tip that is off, and a torque that drifts: beside the first an offset had taken up a part."""
    log = off(drifted(3.5), TIP, lambda share: 4.0 + 0.0 * share)
    before = nominal_rig(start_of_search(log, effects=()), Workers())
    pair = ("tip_angle_bias", "drive_friction")
    coarse, fine = (candidate(fit_effects(own, pair)) for own in (before.coarse, before.problem))
    before = replace(before, pairs=(coarse,)).adding(([fine], ()))
    after = drift_of_the_torque_sensor(before, Workers())
    assert ("tip_angle_bias",) in [c.names for c in after.candidates]
    assert [*after.problem.noise.drifts] == [TORQUE]
