"""Noise that is not of one size, of every kind."""

import numpy as np
import pytest
from diagnosis_fixtures import NOISE, TIP, prepared, trial, turns

from diagnosis.prepare.noise.growing_noise import GrowingNoise
from diagnosis.prepare.noise.noise_of_trials import NoiseOfTrials
from diagnosis.prepare.noise.varying_noise import VaryingNoise

SENSOR, OTHER = "tip_angle_deg", "base_torque_n_mm"
GROWS = GrowingNoise(
    grows_with="rate", growth_per_unit=0.02, factor=3.0, rms_factor=1.5, noise_ratio=1.2
)
BY_TRIAL = NoiseOfTrials(ratios={"trial_01.csv": 0.5, "trial_02.csv": 1.3}, noise_ratio=0.9)


@pytest.fixture(scope="module")
def one():
    return prepared(trial(turns()))


@pytest.mark.parametrize("kind", [GROWS, BY_TRIAL])
def test_every_sample_has_a_size_and_the_report_a_sentence(one, kind):
    own: VaryingNoise = kind
    assert own.sizes(one).shape == one.time_s.shape
    assert (own.sizes(one) > 0).all()
    (note,) = NOISE.varying({SENSOR: own}).notes
    assert note == f"{SENSOR}: the noise {own.in_words}; samples count accordingly"


def test_of_noise_that_varies_in_two_ways_both_count(one):
    noise = NOISE.varying({SENSOR: GROWS}).varying({SENSOR: BY_TRIAL})
    np.testing.assert_allclose(noise.sizes(SENSOR, one), GROWS.sizes(one) * BY_TRIAL.sizes(one))
    assert noise[SENSOR] == pytest.approx(TIP * 1.2 * 0.9)
    np.testing.assert_array_equal(noise.sizes(OTHER, one), 1.0)
    assert noise[OTHER] == NOISE[OTHER]
