"""Everything that is told beside the verdict."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import log_of

from diagnosis.assessment import assess as module
from diagnosis.assessment import forward_step, nearest
from diagnosis.assessment.assess import assess
from diagnosis.fitting.decimation import decimated
from diagnosis.fitting.fit import fit_effects, nominal_fit
from diagnosis.fitting.noise_reestimation import in_units_of
from diagnosis.log.trial import Trial
from diagnosis.nominal_replay import at_samples, nominal_residuals, replay_nominal
from diagnosis.prepare.noise.noise_colour import NoiseColour
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.selection.candidate import candidate
from diagnosis.selection.verdicts.decision import verdict_on
from diagnosis.selection.verdicts.verdict import VerdictKind
from diagnosis.workers import Workers
from sim.needles.run import SimulationFailed

DRY = RigParameters(kinetic_n_mm_per_mm=0.001)


@pytest.fixture(scope="module")
def log():
    """A trial with a gap while the base holds."""
    whole = log_of(DRY, speed=-1.0, seconds=6.0)
    table = whole.trials[0].table
    kept = table[(table["time_s"] < 3.0) | (table["time_s"] > 3.2)].reset_index(drop=True)
    names = ("trial_01.csv", "trial_02.csv")
    return replace(whole, trials=tuple(Trial(name=name, table=kept) for name in names))


@pytest.fixture(scope="module")
def nominal(log):
    return replay_nominal(log)


@pytest.fixture(scope="module")
def fitted(nominal):
    start = np.array([np.log(0.001), 0, 0, 0])
    return candidate(fit_effects(nominal.problem, ("coulomb_friction",), start))


def assessed(log, nominal, best, effects=("tip_drag",)):
    """What is told of a candidate."""
    coarse = decimated(nominal.problem, nominal.predictions)
    verdict = verdict_on([best.cross_validated(nominal.problem)])
    predictions = nominal.predictions
    return assess(log, nominal.problem, coarse, predictions, verdict, effects, Workers())


def test_an_explanation_is_told_with_its_parameters_gap_and_limits(log, nominal, fitted):
    told = assessed(log, nominal, fitted)
    level = told.parameters["coulomb_friction"]["level"]
    assert level.low < 0.001 < level.high
    assert set(told.parameters) == {"coulomb_friction"}
    assert told.gap.before > 2
    assert told.gap.after < 1.1
    assert set(told.with_one_more) == set(told.detection_limits) == {"tip_drag"}
    assert told.warnings == ()
    assert told.next_experiment.startswith("add dry friction of 0.00")
    assert told.joint.names[0] == "coulomb_friction.level"
    assert told.joint.values[0] == level.value
    assert list(told.twist.along) == ["nominal", "explained"]
    assert told.breakdown_after.signal["tip_angle_deg"] < told.breakdown.signal["tip_angle_deg"]
    before, after = (s.autocorrelation["tip_angle_deg"] for s in (told.shape, told.shape_after))
    assert before.lag_one_correlation > 0.5 > abs(after.lag_one_correlation)


def test_predictions_are_at_the_samples_of_the_log(log, nominal, fitted):
    told = assessed(log, nominal, fitted)
    samples = len(log.trials[0].table)
    assert told.explained[0].tip_angle_deg.size == samples
    assert nominal.predictions[0].tip_angle_deg.size > samples
    assert at_samples(nominal.problem, nominal.predictions)[0].tip_angle_deg.size == samples


def test_a_parameter_at_its_bound_earns_a_warning_that_names_it():
    (said,) = module._bound_warnings(("coulomb_friction.level",), VerdictKind.EXPLAINED)
    assert said.startswith("coulomb_friction.level stopped at a bound")
    assert module._bound_warnings((), VerdictKind.EXPLAINED) == ()


def test_a_bound_of_what_explains_nothing_is_told_as_that_of_what_comes_nearest():
    (said,) = module._bound_warnings(("stiction.kinetic",), VerdictKind.UNKNOWN)
    assert said.startswith("what comes nearest, which is no explanation: stiction.kinetic stopped")


def test_of_one_trial_none_is_held_out(log, nominal, fitted):
    alone = replace(nominal.problem.log, trials=nominal.problem.log.trials[:1])
    after, said = nearest._held_out(replace(nominal.problem, log=alone), fitted)
    assert after is fitted.fit.by_trial
    assert said == (nearest.ONE_TRIAL,)


def test_held_out_trials_are_not_simulated_again(log, nominal, fitted, monkeypatch):
    monkeypatch.setattr(nearest, "held_out_or_refitted", pytest.fail)
    assert assessed(log, nominal, fitted).gap.after < 1.1


def test_the_fitted_gap_is_in_the_units_of_the_gap_whatever_the_colour_of_the_noise(nominal, fitted):
    """Whitened by neighbours that it resembles, a residual is smaller; in units of sigma it is not."""
    problem, colour = nominal.problem, NoiseColour.of(share=0.9, correlation_time_s=0.1)
    coloured = replace(problem, noise=replace(problem.noise, colour={"tip_angle_deg": colour}))
    swinging = tuple(np.sin(np.arange(r.size) / 20.0) for r in fitted.fit.by_trial)
    white = candidate(replace(fitted.fit, by_trial=swinging))
    whitened = candidate(replace(fitted.fit, by_trial=in_units_of(problem, swinging, coloured.noise)))
    assert whitened.fit.gap < 0.8 * white.fit.gap
    own = module._fitted_gap(coloured, whitened)
    assert own == pytest.approx(module._fitted_gap(problem, white), rel=1e-6)


def failing(*_):
    raise SimulationFailed("lost its numbers")


def test_where_held_out_trials_cannot_be_simulated_the_gap_is_that_of_the_fit(log, nominal, monkeypatch):
    monkeypatch.setattr(nearest, "held_out_or_refitted", failing)
    exact = candidate(nominal_fit(nominal_residuals(nominal.problem, nominal.predictions)))
    told = assessed(log, nominal, exact)
    assert told.gap.after == told.gap.before == pytest.approx(exact.floor.gap)
    (warning,) = told.warnings
    assert "with the parameters from the others (lost its numbers)" in warning


@pytest.mark.parametrize(
    ("name", "lost"),
    [
        ("covariance", "noise of the base angle in the intervals"),
        ("advise", "next experiment"),
        ("strongest_first", "order of the effects by strength"),
    ],
)
def test_a_verdict_stands_where_a_run_beside_it_cannot_be_simulated(
    name, lost, log, nominal, fitted, monkeypatch
):
    monkeypatch.setattr(module, name, lambda *_, **__: failing())
    if name == "strongest_first":  # which is asked for where nothing is accepted
        monkeypatch.setattr(module, "advise", lambda *_: "look closer")
        fitted = candidate(replace(fitted.fit, by_trial=tuple(3.0 * r for r in fitted.fit.by_trial)))
    told = assessed(log, nominal, fitted)
    assert f"{lost}: could not be simulated (lost its numbers)" in told.warnings
    assert told.nearest.effects == ("coulomb_friction",)
    level = told.nearest.parameters["coulomb_friction"]["level"]
    assert level.low < level.value < level.high


def test_where_the_best_cannot_be_simulated_coarsely_nothing_further_is_told(
    log, nominal, fitted, monkeypatch
):
    monkeypatch.setattr(forward_step, "on_decimated", failing)
    told = assessed(log, nominal, fitted)
    assert told.with_one_more == told.detection_limits == {}
    assert told.parameters


def test_no_limits_are_told_where_nothing_explains_the_log(log, nominal):
    exact = candidate(nominal_fit(nominal_residuals(nominal.problem, nominal.predictions)))
    told = assessed(log, nominal, exact)
    assert verdict_on([exact]).kind is VerdictKind.UNKNOWN
    assert told.detection_limits == {}
    assert told.with_one_more
    assert told.next_experiment.startswith("no effect of the library explains")


def test_the_assessment_of_a_whole_diagnosis_simulates_no_held_out_trial(dry):
    best = dry.found.verdict.best
    assert best.held_out is not None
    assert not dry.spy.held_out["assessment"]
    # Asked whether a second effect is needed, and for the verdict: simulated once.
    assert dry.spy.held_out["search"][best.names] == 1
