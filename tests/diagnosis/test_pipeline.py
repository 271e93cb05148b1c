"""From a log to a diagnosis."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest
from diagnosis_fixtures import concluded, joined, log_of, start_of_search
from reference_log import BETA, make_log

from diagnosis import pipeline
from diagnosis.criteria.fitting import NOISE_TRUST
from diagnosis.fitting.fit import fit_effects
from diagnosis.fitting.noise_floor import floor_of
from diagnosis.log.rig_log import read_rig_log
from diagnosis.log.trial import SENSORS, TORQUE
from diagnosis.nominal_replay import replay_nominal
from diagnosis.pipeline import diagnose
from diagnosis.prepare.noise.drift import AllowedDrift
from diagnosis.replay import replay as replaying
from diagnosis.replay.rig_parameters import NOMINAL, RigParameters
from diagnosis.selection.candidate import candidate
from diagnosis.selection.record import Decision
from diagnosis.selection.search import search
from diagnosis.selection.verdicts.decision import verdict_on
from diagnosis.selection.verdicts.verdict import VerdictKind
from diagnosis.workers import Workers
from sim.needles.run import SimulationFailed

DRY = RigParameters(kinetic_n_mm_per_mm=0.001)


def test_dry_friction_is_found_where_others_would_see_damping(dry):
    verdict = dry.found.verdict
    assert (verdict.kind, verdict.effects) == (VerdictKind.EXPLAINED, ("coulomb_friction",))


def test_what_is_missing_of_a_refuted_explanation_is_looked_for_without_drift(monkeypatch):
    """A drift would hide a part of it; the explanation is told as it is without."""
    nominal = replay_nominal(log_of(DRY, speed=-1.0, seconds=8.0))
    drifting = nominal.problem.noise.with_drift(TORQUE, AllowedDrift(size=0.05))
    fine = replace(nominal.problem, noise=drifting)
    coarse = replace(start_of_search(nominal.log, ()).coarse, noise=drifting)
    fit = fit_effects(fine, ("coulomb_friction",))
    verdict = replace(verdict_on([candidate(fit)]), kind=VerdictKind.EXPLAINED)
    form = SimpleNamespace(in_words="a law over the rate leaves less")
    monkeypatch.setattr(pipeline, "other_form", lambda *_: form)
    judged = pipeline.Judged(problem=fine, coarse=coarse, verdict=verdict, record=())
    found = pipeline._of_another_form(judged, nominal, Workers())
    assert found.verdict.kind is VerdictKind.UNKNOWN
    assert found.verdict.other_form == "a law over the rate leaves less"
    for problem in (found.problem, found.coarse):
        assert not problem.noise.drifts
    left = found.problem.residuals([fit.parameterization.rig(fit.x)])
    cost = fit.prior + sum(float(own[0] @ own[0]) for own in left)
    assert found.verdict.best.fit.cost == pytest.approx(cost, rel=1e-6)
    assert fit.cost < 0.999 * cost


def test_the_nominal_rig_is_replayed_once(dry):
    assert dry.spy.nominal == 1


def test_both_problems_carry_the_noise_that_the_best_explanation_leaves(dry):
    fine, coarse = dry.spy.assessed
    start = start_of_search(dry.log)
    for sensor in SENSORS:
        change = fine.noise[sensor] / start.problem.noise[sensor]
        assert change != 1.0
        assert abs(change - 1) <= NOISE_TRUST
        assert coarse.noise[sensor] == pytest.approx(change * start.coarse.noise[sensor])
    assert dry.found.noise is fine.noise


def test_a_nominal_replay_is_that_of_the_diagnosis_but_for_the_noise(dry):
    """Residuals are the same; gaps differ by the ratio of the noises alone."""
    nominal = replay_nominal(dry.log)
    for sensor in SENSORS:
        before, after = nominal.problem.noise[sensor], dry.found.noise[sensor]
        gaps = []
        for one, other in zip(nominal.predictions, dry.found.nominal, strict=True):
            np.testing.assert_array_equal(one[sensor], other[sensor])
        each = zip(nominal.problem.log.trials, nominal.predictions, strict=True)
        left = np.concatenate([t.readings[sensor] - p[sensor] for t, p in each])
        gaps = [np.sqrt(np.mean((left / before) ** 2)), dry.found.assessment.breakdown.signal[sensor]]
        assert gaps[1] / gaps[0] == pytest.approx(before / after, rel=1e-12)
        assert abs(after / before - 1) <= NOISE_TRUST


@pytest.mark.slow
def test_a_weak_second_effect_is_found_though_the_first_alone_is_at_the_floor(tmp_path):
    effects = {"tip_angle_bias": {"bias": 2.5}, "tip_drag": {"damping": 0.025}}
    log = read_rig_log(make_log(tmp_path / "log", effects))
    start = start_of_search(log)
    assert set(concluded(search(start, Workers())).effects) == {"tip_angle_bias", "tip_drag"}
    alone = fit_effects(start.problem, ("tip_angle_bias",))
    assert floor_of(alone.by_trial).reached


@pytest.mark.slow
def test_without_torque_a_damping_that_is_off_is_undecided_against_stiffness(tmp_path):
    """The tip feels only their ratio: each alone is within a rig's scatter, the ratio is not.

    An inserted length that is off by half a millimetre, and less scatter of both, leave as little.
    """
    folder = make_log(tmp_path / "log", {}, damping=0.96 * BETA, seed=5)
    for path in folder.glob("trial_*.csv"):
        pd.read_csv(path).drop(columns="base_torque_n_mm").to_csv(path, index=False)
    found = diagnose(read_rig_log(folder), workers=1)
    assert found.verdict.kind is VerdictKind.UNDECIDED
    either = {("damping_error",), ("stiffness_error",)}
    assert set(found.verdict.confusable) == {*either, ("inserted_offset",)}
    assert ": no run that this rig can do" in found.assessment.next_experiment


def _held(time_s, values):
    """Read every 40 ms, and written every 10."""
    return values[np.arange(time_s.size) // 4 * 4]


def _on_lines(time_s, values):
    """Read every 40 ms, and interpolated."""
    return np.interp(time_s, time_s[::4], values[::4])


def _humming(time_s, values):
    return values + 0.5 * np.sin(2 * np.pi * 50.02 * time_s)


@pytest.mark.slow
@pytest.mark.parametrize("logged", [_held, _on_lines, _humming])
def test_a_tip_that_is_logged_as_labs_do_lacks_nothing(logged, tmp_path):
    """Of an exact rig; repeated readings look like a tip sensor that is 15 ms late."""
    folder = make_log(tmp_path / "log", {}, seed=6)
    for path in folder.glob("trial_*.csv"):
        table = pd.read_csv(path)
        tip = logged(table["time_s"].to_numpy(), table["tip_angle_deg"].to_numpy())
        table.assign(tip_angle_deg=tip).to_csv(path, index=False)
    found = diagnose(read_rig_log(folder), workers=1)
    assert found.verdict.kind is VerdictKind.NONE
    assert found.verdict.best.floor.reached


@pytest.mark.slow
def test_dry_friction_that_never_slides_is_undecided_and_the_next_experiment_slides():
    found = diagnose(log_of(DRY), workers=1)
    assert found.verdict.kind is VerdictKind.UNDECIDED
    both = {("coulomb_friction",), ("speed_dependent_friction",)}
    assert both <= set(found.verdict.confusable)
    assert "sliding" in found.assessment.next_experiment
    assert "standard deviations apart" in found.assessment.next_experiment


@pytest.mark.slow
def test_dry_friction_that_slides_is_told_from_that_which_shares_itself_with_the_motion():
    sliding = joined(log_of(DRY), log_of(DRY, speed=-2.0, seed=1))
    kinds = ("coulomb_friction", "speed_dependent_friction", "stiction")
    found = search(start_of_search(sliding, kinds), Workers())
    assert concluded(found).effects == ("coulomb_friction",)


@pytest.mark.parametrize(("rig", "kind"), [(NOMINAL, VerdictKind.NONE), (DRY, VerdictKind.UNKNOWN)])
def test_where_nothing_but_the_nominal_rig_can_be_simulated_there_is_a_verdict(rig, kind, monkeypatch):
    log = log_of(rig, speed=-1.0, seed=1)
    original = replaying._run

    def nominal_alone(nominal, trial, rigs, *arguments, **options):
        if any(rig != NOMINAL for rig in rigs):
            raise SimulationFailed("the simulation lost its numbers")
        return original(nominal, trial, rigs, *arguments, **options)

    monkeypatch.setattr(replaying, "_run", nominal_alone)
    found = diagnose(log, workers=1)
    assert found.verdict.kind is kind
    assert found.verdict.best.names == ()
    lost = {e.effects for e in found.record if e.decision is Decision.FAILED}
    assert () in lost
    assert any(warning.startswith("the nominal rig: not fully tried") for warning in found.warnings)


def test_an_effect_that_may_as_well_be_absent_is_not_part_of_the_answer(monkeypatch):
    """Its interval is made to begin at no friction."""
    inner = pipeline.assess

    def assess(*arguments):
        found = inner(*arguments)
        level = replace(found.parameters["coulomb_friction"]["level"], low=0.0)
        return replace(found, parameters={"coulomb_friction": {"level": level}})

    monkeypatch.setattr(pipeline, "assess", assess)
    found = diagnose(log_of(DRY, speed=-1.0, seed=1), workers=1)
    assert (found.verdict.kind, found.verdict.effects) == (VerdictKind.NONE, ())
    assert found.verdict.confusable == ((), ("coulomb_friction",))
    assert found.assessment.parameters == {}
    assert found.record[-1].decision is Decision.DROPPED
    assert "coulomb_friction: the interval reaches its absence" in found.record[-1].reason


def test_an_explanation_that_predicts_unseen_trials_worse_is_none(monkeypatch):
    """Its gap on these is made to grow; the nominal rig, which explains nothing, is not refuted."""
    inner, log = pipeline.assess, log_of(DRY, speed=-1.0, seed=1)

    def assess(*arguments):
        found = inner(*arguments)
        worse = replace(found.gap, before=1.01, after=1.2, shrink_high=-0.1)
        return replace(found, gap=worse)

    monkeypatch.setattr(pipeline, "assess", assess)
    monkeypatch.setattr(pipeline, "with_what_is_missing", lambda _, told, *__: told)
    found = diagnose(log, workers=1)
    assert (found.verdict.kind, found.verdict.effects) == (VerdictKind.UNKNOWN, ())
    assert "1.2 instead of 1.01 σ" in found.verdict.other_form
    assert found.record[-1].decision is Decision.DROPPED
    nominal = diagnose(log_of(NOMINAL, seconds=2.0), workers=1)
    assert nominal.verdict.kind is VerdictKind.NONE


def test_progress_is_told_by_stage():
    told = []
    log = log_of(NOMINAL, seconds=2.0)
    diagnose(log, workers=1, progress=told.append)
    stages = list(dict.fromkeys(news.stage for news in told))
    begin = ["replaying the nominal rig", "fitting the nominal rig", "screening single effects"]
    assert stages[:3] == begin
    assert stages[-1] == "computing detection limits"
    assert all(0 <= news.done <= news.tasks for news in told)
