"""Trials that begin wound up, as the best explanation shows, where only that explains a log."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import joined, log_of, start_of_search, turns

from diagnosis.criteria.prepare import START_LEFT_SHARE
from diagnosis.log.trial import Trial
from diagnosis.nominal_replay import replay_nominal
from diagnosis.prepare.noise.drift import AllowedDrift
from diagnosis.replay.rig_parameters import NOMINAL, RigParameters
from diagnosis.selection.record import Decision
from diagnosis.selection.stages.sensors.sensor_drift import drift_of_the_tip_sensor
from diagnosis.selection.stages.single_effects import single_effects
from diagnosis.selection.stages.starts_left import (
    STAGE,
    share_at_the_start,
    starts_and_more,
    starts_of_trials,
)
from diagnosis.workers import Workers

BENT = RigParameters(curvature_n_mm_per_mm=0.0004, curvature_phase_deg=100.0)
RESTS_S = 4.0


def rested(rig, seed):
    """A log of a needle that has rested for some seconds before its first sample."""
    rest = np.zeros(int(RESTS_S / 0.01))
    log = log_of(rig, seed=seed, angle=np.concatenate([rest, turns(9.0)]))
    (one,) = log.trials
    table = one.table[one.table["time_s"] >= RESTS_S - 1e-9].reset_index(drop=True)
    table = table.assign(time_s=table["time_s"] - table["time_s"][0])
    return replace(log, trials=(Trial(name=one.name, table=table),))


def searched(log, effects=("needle_curvature",)):
    state = single_effects(start_of_search(log, effects=effects), Workers())
    return state, starts_of_trials(state, Workers())


def decisions(state):
    return [e.decision for e in state.record if e.stage == STAGE and e.score is None]


@pytest.fixture(scope="module")
def bent():
    return searched(joined(rested(BENT, 1), rested(BENT, 2)))


def test_a_bent_needle_that_had_come_to_rest_is_explained_by_its_curvature_alone(bent):
    before, after = bent
    assert not before.best.floor.reached
    assert share_at_the_start(before) > START_LEFT_SHARE
    assert after.best.floor.reached
    assert after.best.names == ("needle_curvature",)
    torque, phase = after.best.fit.parts["needle_curvature"]
    torque, phase = after.best.fit.parameterization.values(after.best.fit.x)[:2]
    assert torque == pytest.approx(BENT.curvature_n_mm_per_mm, rel=0.1)
    assert phase == pytest.approx(BENT.curvature_phase_deg, abs=5.0)
    assert decisions(after) == [Decision.KEPT]
    assert all(trial.late_start for trial in after.problem.log.trials)


def test_another_noise_meets_no_fit_of_the_decimated_log_as_it_was(bent):
    """Its rows are others once trials have a past."""
    before, after = bent
    assert before.singles
    assert (after.singles, after.pairs, after.triples) == ((), (), ())
    drifting = after.problem.noise.with_drift("tip_angle_deg", AllowedDrift(size=0.1))
    assert after.renoised(drifting).best.names == after.best.names


def test_readings_that_are_not_used_leave_the_log_too(bent):
    """Where the nominal rig is replayed for the report, it has the pasts of the search."""
    _, after = bent
    nominal = replay_nominal(joined(rested(BENT, 1), rested(BENT, 2)))
    begun = nominal.begun_as(after.problem, after.nominal)
    unused = [int(np.isnan(t["tip_angle_deg"]).sum()) for t in begun.log.trials]
    each = after.problem.log.trials
    assert unused == [int(np.isnan(t.readings["tip_angle_deg"]).sum()) for t in each]
    assert min(unused) > 0
    assert begun.rig.pasts
    assert nominal.begun_as(nominal.problem, nominal.fit) is nominal


def test_what_is_explained_is_left_alone():
    before, after = searched(rested(NOMINAL, 3))
    assert after.problem is before.problem
    assert decisions(after) == []


def test_a_law_that_acts_all_the_time_is_no_start():
    """Dry friction that may not be fitted."""
    before, after = searched(rested(RigParameters(kinetic_n_mm_per_mm=0.001), 4))
    assert not before.best.floor.reached
    assert share_at_the_start(before) < START_LEFT_SHARE
    assert after.problem is before.problem
    assert decisions(after) == []


def test_where_pasts_do_not_explain_the_log_they_are_dropped(monkeypatch):
    module = "diagnosis.selection.stages.starts_left.share_at_the_start"
    monkeypatch.setattr(module, lambda _: 1.0)
    before, after = searched(rested(RigParameters(kinetic_n_mm_per_mm=0.001), 4))
    assert after.problem is before.problem
    assert decisions(after) == [Decision.DROPPED]


def rested_in_the_play(rig, back_deg, seed):
    """A log whose base has turned back a little before its first sample, and then rests for some time.

    Both angles are told from where the base is then.
    """
    before = np.concatenate([np.linspace(back_deg, 0.0, 100), np.zeros(100)])
    log = log_of(rig, seed=seed, angle=np.concatenate([before, np.zeros(300), turns(9.0)]))
    (one,) = log.trials
    table = one.table.iloc[before.size :].reset_index(drop=True)
    table = table.assign(time_s=table["time_s"] - table["time_s"][0])
    return replace(log, trials=(Trial(name=one.name, table=table),))


def test_a_needle_may_rest_anywhere_in_the_play_of_its_chuck():
    """It lags until the base has turned by the play, however long that takes."""
    loose, backs_deg = RigParameters(backlash_deg=4.0), (0.6, -0.6)
    log = joined(*(rested_in_the_play(loose, back, seed) for seed, back in enumerate(backs_deg)))
    before, after = searched(log, effects=("chuck_backlash",))
    assert not before.best.floor.reached
    assert share_at_the_start(before) > START_LEFT_SHARE
    assert decisions(after) == [Decision.KEPT]
    assert after.best.floor.reached
    (gap,) = after.best.fit.parameterization.values(after.best.fit.x)[:1]
    assert gap == pytest.approx(loose.backlash_deg, rel=0.05)


def test_an_imperfection_that_the_starts_had_hidden_is_found_beside_them():
    loose, backs_deg = RigParameters(backlash_deg=4.0, torque_low_pass_s=0.005), (0.6, -0.6)
    log = joined(*(rested_in_the_play(loose, back, seed) for seed, back in enumerate(backs_deg)))
    names = ("chuck_backlash", "torque_low_pass")
    state = single_effects(start_of_search(log, effects=names[:1]), Workers())
    after = starts_of_trials(replace(state, effects=names), Workers())
    assert decisions(after) == [Decision.KEPT]
    assert after.best.floor.reached
    assert after.best.names == names
    _, constant_s = after.best.fit.parameterization.values(after.best.fit.x)[:2]
    assert constant_s == pytest.approx(0.005, rel=0.05)


def drifting(log, by_deg):
    """The log with tips that drift along a straight line."""
    trials = [
        Trial(
            name=one.name,
            table=one.table.assign(tip_angle_deg=one["tip_angle_deg"] + size * (one["time_s"] / 9.0)),
        )
        for one, size in zip(log.trials, by_deg, strict=True)
    ]
    return replace(log, trials=tuple(trials))


def test_a_bent_needle_that_rested_is_found_beside_a_drift_of_the_tip():
    """Neither starts nor drift explain the log alone; where trials have none, none is asked for."""
    log = drifting(joined(rested(BENT, 1), rested(BENT, 2)), (0.2, -0.2))
    state, alone = searched(log)
    assert not alone.best.floor.reached
    assert not drift_of_the_tip_sensor(state, Workers()).best.floor.reached
    after = starts_and_more((drift_of_the_tip_sensor,))(state, Workers())
    assert after.best.floor.reached
    assert after.best.names == ("needle_curvature",)
    assert after.record[-1].decision is Decision.KEPT
    asked = []
    starts_and_more((lambda own, _: asked.append(own) or own,))(bare(log_of(BENT)), Workers())
    assert not asked


def bare(log):
    return single_effects(start_of_search(log, effects=("coulomb_friction",)), Workers())
