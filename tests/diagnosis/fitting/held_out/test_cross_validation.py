"""What a fit predicts on trials that it has not seen."""

import numpy as np
import pytest
from diagnosis_fixtures import fit_of, held_by_a_bound, joined, log_of, problem_of

from diagnosis.criteria.fitting import SCATTER
from diagnosis.effects import LIBRARY
from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.fitting.fit import fit_effects
from diagnosis.fitting.held_out.cross_validation import (
    _steps,
    held_out_residuals,
    information,
    shift_statistic,
)
from diagnosis.fitting.nuisance import prior_sigma
from diagnosis.replay.rig_parameters import RigParameters

SCALES = tuple(LIBRARY[name] for name in SCATTER)


def linear(offsets, name="tip_angle_bias"):
    """A fit of one parameter to trials that each ask for their own value of it."""
    rng = np.random.default_rng(1)
    slopes = [np.ones((400, 1)) for _ in offsets]
    by_trial = [rng.normal(size=400) + offset for offset in offsets]
    middle = np.mean([r.mean() for r in by_trial])
    return fit_of((name,), by_trial=[r - middle for r in by_trial], jacobian=slopes)


def test_a_parameter_that_is_held_by_its_bound_holds_the_others_on_held_out_trials():
    assert shift_statistic(held_by_a_bound(0.03)) < 3


def test_the_shift_is_that_of_the_closed_form():
    """One parameter, K trials of N samples: the mean of the others moves a trial by d_i.

    Its square over the noise of that mean, N (K - 1) samples, is N sum d_i^2 over N K / (N (K - 1)).
    """
    fit = linear([0.0, 0.3, -0.2])
    means = np.array([r.mean() for r in fit.by_trial])
    moves = np.array([np.delete(means, i).mean() for i in range(3)])
    expected = 400 * np.sum(moves**2) / (3 * 400 / (2 * 400))
    # The ridge on what nothing else tells is 3e-5.
    assert shift_statistic(fit) == pytest.approx(expected, rel=1e-3)


def test_trials_that_tell_the_same_shift_by_about_one():
    # A chi-square of one: exceeds 9 once in 370 logs.
    assert shift_statistic(linear([0.0, 0.0])) < 9
    assert shift_statistic(linear([0.0, 1.0])) > 9


@pytest.mark.parametrize("clock", ["tip_clock", "torque_clock"])
def test_a_clock_may_run_off_by_another_rate_in_each_trial(clock):
    assert shift_statistic(linear([0.0, 1.0], clock)) == 0.0


def with_pasts(pulls):
    """A linear fit of one bias to three trials of which the last began late, at its optimum.

    Args:
      pulls: bias that every trial asks for.
    """
    rng = np.random.default_rng(6)
    fading = np.exp(-np.linspace(0, 4, 400))
    start = Effect(
        name="start of trial_03.csv",
        title="",
        place=Place.DRIVE,
        parameters=(Parameter(name="turned", unit="deg", low=-100, high=100, start=(0.0,)),),
        apply=lambda rig, _: rig,
        trial="trial_03.csv",
    )
    slopes = [np.column_stack([np.ones(400), late * fading]) for late in (0.0, 0.0, 1.0)]
    readings = [rng.normal(size=400) - pull for pull in pulls]
    prior = np.diag([0.0, 1 / prior_sigma(start)])
    matrix, wanted = np.vstack([*slopes, prior]), np.concatenate([*readings, np.zeros(2)])
    x = -np.linalg.lstsq(matrix, wanted, rcond=None)[0]
    by_trial = [r + j @ x for r, j in zip(readings, slopes, strict=True)]
    return fit_of(
        ("tip_angle_bias",), by_trial=by_trial, jacobian=slopes, x=x, nuisance=(start,)
    ), readings


def test_the_start_of_a_held_out_trial_is_fitted_to_it_while_the_others_tell_the_rest():
    fit, readings = with_pasts((0.0, 0.0, 1.0))
    bias, start = fit.x + _steps(fit)[2]
    # The others are two trials without a start: their mean, to a ridge of 3e-5.
    assert bias == pytest.approx(-np.concatenate(readings[:2]).mean(), abs=1e-6)
    fading = fit.jacobian[2][:, 1]
    left = readings[2] + bias
    weight = fit.parameterization.weights[1]
    assert start == pytest.approx(-(fading @ left) / (fading @ fading + weight**2), rel=1e-6)


def test_a_trial_that_began_late_shifts_as_others_do():
    # A chi-square of one, three times: exceeds 9 once in 370 logs.
    assert shift_statistic(with_pasts((0.0, 0.0, 0.0))[0]) < 9
    assert shift_statistic(with_pasts((0.0, 0.0, 1.0))[0]) > 9


def test_information_is_that_of_the_slopes_and_of_the_prior():
    slopes = [np.random.default_rng(i).normal(size=(50, 3)) for i in range(2)]
    fit = fit_of(("tip_drag",), by_trial=np.zeros((2, 50)), jacobian=slopes, nuisance=SCALES)
    prior = np.diag([0.0, *(1 / SCATTER[e.name] ** 2 for e in SCALES)])
    whole = sum(j.T @ j for j in slopes) + prior
    np.testing.assert_allclose(information(fit), whole, atol=1e-8)
    np.testing.assert_allclose(information(fit, without=0), slopes[1].T @ slopes[1] + prior, atol=1e-8)


def test_a_held_out_trial_is_predicted_from_the_others_alone():
    """A level of friction that one trial lacks: the other says nothing of it, and it is not there."""
    logs = (
        log_of(RigParameters(kinetic_n_mm_per_mm=level), seconds=6.0, seed=i)
        for i, level in enumerate((0.001, 0.0012))
    )
    problem = problem_of(joined(*logs))
    fit = fit_effects(problem, ("coulomb_friction",), np.array([np.log(0.001), 0, 0]))
    held_out = held_out_residuals(problem, fit)
    assert [r.size for r in held_out] == [r.size for r in fit.by_trial]
    fitted, unseen = (sum(float(r @ r) for r in each) for each in (fit.by_trial, held_out))
    assert unseen > 1.5 * fitted


def test_a_log_of_one_trial_is_predicted_from_itself():
    problem = problem_of(log_of(RigParameters(), seconds=3.0))
    fit = fit_effects(problem, (), most_iterations=1)
    np.testing.assert_array_equal(held_out_residuals(problem, fit)[0], fit.by_trial[0])
    assert shift_statistic(fit) == 0.0
