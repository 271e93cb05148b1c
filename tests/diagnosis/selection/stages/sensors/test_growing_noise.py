"""Noise that grows with the rate, where nothing else explains a log."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import TIP, log_of
from varying_logs import (
    SENSOR,
    check_it_is_allowed_for_and_told,
    check_it_is_left_alone,
    searched,
)

from diagnosis.log.trial import Trial
from diagnosis.replay.rig_parameters import NOMINAL
from diagnosis.selection.stages.sensors.growing_noise import STAGE, noise_that_grows

FACTOR = 16.0
SECONDS = 30.0


def growing(log, seed=5):
    """The log, with noise of the tip that is so many times as large at the largest rate."""
    (one,) = log.trials
    rate = np.abs(np.gradient(one["base_angle_deg"], one["time_s"]))
    rate = np.convolve(rate, np.full(31, 1 / 31), "same")
    more = np.sqrt((1 + (FACTOR - 1) * rate / rate.max()) ** 2 - 1)
    noise = TIP * more * np.random.default_rng(seed).normal(size=rate.size)
    table = one.table.assign(tip_angle_deg=one["tip_angle_deg"] + noise)
    return replace(log, trials=(Trial(name=one.name, table=table),))


@pytest.fixture(scope="module")
def both():
    """A base that turns fast for short times, so that most samples have the noise of rest."""
    time = np.arange(0, SECONDS, 0.01)
    swings = 60 * np.sin(1.5 * time) ** 15
    return searched(growing(log_of(NOMINAL, seconds=SECONDS, angle=swings)), noise_that_grows)


def test_noise_that_grows_is_allowed_for_and_told(both):
    check_it_is_allowed_for_and_told(*both, STAGE, "grows with")


def test_what_was_fitted_is_in_units_of_the_noise_that_grows(both):
    """As a replay of the weighted log has it."""
    _, after = both
    ((replayed,),) = after.problem.residuals([NOMINAL])
    np.testing.assert_allclose(after.nominal.by_trial[0], replayed, rtol=1e-9, atol=1e-9)


def test_means_of_a_decimated_log_count_by_the_noise_of_their_samples(both):
    _, after = both
    (trial,) = after.problem.log.trials
    sizes = after.problem.noise.varies[SENSOR][0].sizes(trial)
    (coarse,) = after.coarse.log.trials
    expected = np.interp(coarse.time_s, trial.time_s, 1 / sizes)
    np.testing.assert_allclose(coarse.weights[SENSOR][2:-2], expected[2:-2], rtol=0.1)


def test_a_log_that_is_explained_is_left_alone():
    check_it_is_left_alone(*searched(log_of(NOMINAL, seconds=12.0), noise_that_grows))
