"""Noise that is another one in each trial, where nothing else explains a log."""

from dataclasses import replace

import numpy as np
import pytest
from varying_logs import (
    MORE,
    SENSOR,
    check_it_is_allowed_for_and_told,
    check_it_is_left_alone,
    four_trials,
    noisy,
    searched,
)

from diagnosis.fitting.noise_reestimation import reestimated_noise
from diagnosis.selection.stages.sensors.noise_by_trial import STAGE, noise_of_each_trial


@pytest.fixture(scope="module")
def both():
    return searched(noisy(four_trials()), noise_of_each_trial)


def test_noise_of_each_trial_is_allowed_for_and_told(both):
    check_it_is_allowed_for_and_told(*both, STAGE, "from trial to trial")


def test_what_was_fitted_is_in_units_of_the_noise_of_its_trial(both):
    """As a replay of the weighted log has it."""
    _, after = both
    nominal = after.nominal
    replayed = after.problem.residuals([nominal.parameterization.rig(nominal.x)])
    for kept, (own,) in zip(nominal.by_trial, replayed, strict=True):
        np.testing.assert_allclose(kept, own, rtol=1e-9, atol=1e-9)


def test_readings_of_every_trial_tell_the_noise_once_more(both):
    """Those of the trial with more noise count less, but are as exact: it has to tell its share."""
    _, after = both
    problem, left = after.problem, list(after.nominal.by_trial)
    again = reestimated_noise(problem, after.nominal)[SENSOR]
    assert again == pytest.approx(problem.noise[SENSOR], rel=0.05)
    last = replace(after.nominal, by_trial=(*left[:-1], 1.1 * left[-1]))
    of_four = np.sqrt((len(MORE) - 1 + 1.1**2) / len(MORE))
    assert reestimated_noise(problem, last)[SENSOR] == pytest.approx(of_four * again, rel=0.005)


def test_means_of_a_decimated_log_count_by_the_noise_of_their_trial(both):
    before, after = both
    by_name = {trial.name: trial for trial in before.coarse.log.trials}
    (varies,) = after.problem.noise.varies[SENSOR]
    for fine, coarse in zip(after.problem.log.trials, after.coarse.log.trials, strict=True):
        own = by_name[coarse.name].weights.get(SENSOR, 1.0)
        expected = np.broadcast_to(own / varies.sizes(fine)[0], coarse.time_s.shape)
        np.testing.assert_allclose(coarse.weights[SENSOR], expected, rtol=1e-6)


def test_a_log_that_is_explained_is_left_alone():
    check_it_is_left_alone(*searched(four_trials(), noise_of_each_trial))
