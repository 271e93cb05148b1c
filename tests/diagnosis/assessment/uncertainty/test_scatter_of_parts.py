"""How far parameters are known where parts of a log disagree, against closed forms and by repetition."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import fit_of, log_of, problem_of
from scipy.stats import binom, t

from diagnosis.assessment.uncertainty.scatter_of_parts import (
    PARTS,
    covariance_by_parts,
)
from diagnosis.criteria.assessment import INTERVAL_Z
from diagnosis.replay.rig_parameters import NOMINAL

DRAWS = 400


@pytest.fixture(scope="module")
def problem():
    """Two trials, of which only the torque is read, in 16 parts of 25 samples."""
    problem = replace(problem_of(log_of(NOMINAL, seconds=2.0)), nuisance=())
    (trial,) = problem.log.trials
    torque = {"base_torque_n_mm": trial.readings["base_torque_n_mm"]}
    trials = (replace(trial, readings=torque),) * 2
    return replace(problem, log=replace(problem.log, trials=trials))


def covariance_where(problem, levels, noise=0.0, left=2.0):
    """Covariance of a mean where parts of the log are off by `levels`, and its estimate."""
    rows = [trial.time_s.size for trial in problem.log.trials]
    rng = np.random.default_rng(3)
    values = [
        np.concatenate(
            [
                np.full(len(p), a)
                for p, a in zip(np.array_split(np.arange(n), PARTS // 2), own, strict=True)
            ]
        )
        + noise * rng.normal(size=n)
        for n, own in zip(rows, np.reshape(levels, (2, PARTS // 2)), strict=True)
    ]
    mean = float(np.mean(np.concatenate(values)))
    slopes = [np.ones((n, 1)) for n in rows]
    fit = fit_of(("torque_bias",), by_trial=[v - mean for v in values], jacobian=slopes)
    inverse = np.array([[1.0 / sum(rows)]])
    return covariance_by_parts(problem, fit, inverse, left)[0, 0], mean, sum(rows)


def test_parts_that_disagree_tell_how_far_a_mean_is_known(problem):
    level = 3.0
    found, mean, _ = covariance_where(problem, [level, -level] * (PARTS // 2))
    assert mean == pytest.approx(0.0, abs=1e-12)
    wider = t.ppf(0.975, PARTS - 1) / INTERVAL_Z
    # The variance of the mean of B levels, each +-level, from their scatter.
    assert found == pytest.approx(wider**2 * level**2 / (PARTS - 1), rel=0.02)


def test_a_residual_that_is_white_is_taken_for_noise_of_its_size(problem):
    found, _, count = covariance_where(problem, [0.0] * PARTS, noise=1.0, left=2.0)
    assert found == pytest.approx(2.0**2 / count)


def test_intervals_hold_the_truth_as_often_as_they_say(problem):
    """Levels of parts are normal about 0."""
    rng, held = np.random.default_rng(11), 0
    for _ in range(DRAWS):
        found, mean, _ = covariance_where(problem, rng.normal(size=PARTS), left=1.0)
        held += abs(mean) <= INTERVAL_Z * np.sqrt(found)
    low, high = binom.ppf([0.001, 0.999], DRAWS, 0.95)
    assert low <= held <= high


def test_parameters_stay_correlated_as_in_the_model(problem):
    rows = [trial.time_s.size for trial in problem.log.trials]
    rng = np.random.default_rng(5)
    slopes = [rng.normal(size=(n, 2)) + 1.0 for n in rows]
    fit = fit_of(("torque_bias", "tip_drag"), by_trial=[10 * np.ones(n) for n in rows], jacobian=slopes)
    inverse = np.linalg.inv(sum(s.T @ s for s in slopes))
    found = covariance_by_parts(problem, fit, inverse, 1.0)
    scale = np.sqrt(np.diag(found) / np.diag(inverse))
    assert found == pytest.approx(inverse * np.outer(scale, scale))
    assert np.all(scale >= 1.0)
