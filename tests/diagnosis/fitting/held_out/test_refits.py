"""Held-out trials by fits to the others, where one step from the fit leads too far."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import TORQUE, joined, log_of, problem_of

from diagnosis.criteria.freeform import FAR_STEP
from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.fitting.fit import fit_effects
from diagnosis.fitting.held_out.cross_validation import held_out_residuals
from diagnosis.fitting.held_out.refits import held_out_or_refitted, plain_gap, refitted_without
from diagnosis.log.trial import SENSORS
from diagnosis.replay.curve import ActsOn, Curve
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.replay.variables import Variable
from diagnosis.stopping import StopSignal, listening

BIASES_N_MM = (0.02, 0.05)


@pytest.fixture(scope="module")
def fitted():
    """Two trials that each ask for their own bias of the torque, and the fit of one bias."""
    problem = problem_of(
        joined(*(log_of(RigParameters(torque_bias_n_mm=b), seconds=6.0) for b in BIASES_N_MM))
    )
    return problem, fit_effects(problem, ("torque_bias",))


def test_each_trial_is_predicted_with_what_the_others_ask_for(fitted):
    """The second is predicted with the bias of the first, and the other way round; torques first."""
    problem, _ = fitted
    for left, trial, sign in zip(refitted_without(*fitted), problem.log.trials, (-1, 1), strict=True):
        torque = left[: np.isfinite(trial.readings[SENSORS[0]]).sum()]
        expected = sign * (BIASES_N_MM[1] - BIASES_N_MM[0]) / TORQUE
        # Each of the two means is known to sigma / sqrt(N).
        assert torque.mean() == pytest.approx(expected, abs=5 * np.sqrt(2 / torque.size))


def offsets(trials):
    """Offsets of the torque sensor, one for each trial."""

    def apply(rig, *values):
        each = zip(trials, values, strict=True)
        curves = (
            Curve(
                acts_on=ActsOn.TORQUE_READING,
                variable=Variable.TIME,
                places=(0.0, 1.0),
                values=(value, value),
                trial=trial,
            )
            for trial, value in each
        )
        return replace(rig, free=FreeLaw(curves=tuple(curves)))

    parameters = tuple(
        Parameter(
            name=trial, unit="N mm", low=-1, high=1, start=(0.0,), prior_sigma=0.1, of_one_trial=True
        )
        for trial in trials
    )
    return Effect(name="offsets", title="", place=Place.SENSOR, parameters=parameters, apply=apply)


@pytest.mark.parametrize("predicted", [held_out_residuals, refitted_without])
def test_numbers_of_one_trial_are_fitted_there(fitted, predicted):
    problem, _ = fitted
    own = offsets([trial.name for trial in problem.log.trials])
    problem = replace(problem, library={**problem.library, own.name: own})
    fit = fit_effects(problem, (own.name,))
    assert fit.parameterization.about_one_trial[:2].all()
    # Nothing is off but the offsets: damping and stiffness from one trial change nothing visible.
    assert plain_gap(fit, predicted(problem, fit)) == pytest.approx(fit.gap, rel=0.01)


@pytest.mark.parametrize(("factor", "refits"), [(0.99, False), (1.01, True)])
def test_refits_are_made_where_a_step_leads_far(fitted, factor, refits):
    problem, fit = fitted
    found = held_out_or_refitted(problem, fit, lambda fit, _: factor * FAR_STEP * fit.gap)
    expected = (refitted_without if refits else held_out_residuals)(problem, fit)
    for one, other in zip(found, expected, strict=True):
        np.testing.assert_allclose(one, other)


def test_where_there_is_no_time_the_step_is_what_there_is(fitted):
    problem, fit = fitted
    with listening(StopSignal(1e-9)):
        found = held_out_or_refitted(problem, fit, lambda fit, _: 2 * FAR_STEP * fit.gap)
    for one, other in zip(found, held_out_residuals(problem, fit), strict=True):
        np.testing.assert_allclose(one, other)


def test_the_gap_of_held_out_trials_is_their_root_mean_square():
    assert plain_gap(None, (np.array([3.0]), np.array([4.0, 5.0]))) == pytest.approx(np.sqrt(50 / 3))
