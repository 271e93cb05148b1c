"""Two filters averaged by probability: the weights are Bayes', and the choice is not for good."""

import math

import numpy as np
import pytest

from controllers.signals import Estimate, Sample
from controllers.steering.model_average import ModelAverage
from models.errors import InvalidValue


class Told:
    """A filter that says what it is told."""

    def __init__(self, tip_deg, log_likelihood):
        self.tip_deg, self.log_likelihood, self.exposed = tip_deg, log_likelihood, 0

    def reset(self):
        self.exposed = 0

    def update(self, sample):
        return Estimate(self.tip_deg)

    def expose(self):
        self.exposed += 1

    def see(self, position_mm):
        return self.log_likelihood


SAMPLE = Sample(0.0, 0.0, 0.0, 50.0, 50.0)


def test_before_any_image_the_mean_is_that_of_the_prior():
    average = ModelAverage(Told(10.0, 0.0), Told(20.0, 0.0), doubt=0.25)
    assert average.update(SAMPLE).tip_deg == pytest.approx(12.5)
    assert average.doubting_estimate.tip_deg == 20.0


def test_an_image_moves_the_weights_by_the_ratio_of_likelihoods():
    trusting, doubting = Told(0.0, -2000.0), Told(1.0, -2000.0 + math.log(9.0))
    average = ModelAverage(trusting, doubting, doubt=0.1)
    average.expose()
    average.see(np.zeros(3))
    posterior = 0.1 * 9 / (0.1 * 9 + 0.9)
    # A thousandth of the weights goes back to where they began.
    assert average.doubt == pytest.approx(0.999 * posterior + 0.001 * 0.1)
    assert (trusting.exposed, doubting.exposed) == (1, 1)
    assert average.update(SAMPLE).tip_deg == pytest.approx(average.doubt)


def test_a_model_that_was_wrong_for_long_comes_back_within_a_few_images():
    trusting, doubting = Told(0.0, 0.0), Told(1.0, -5.0)
    average = ModelAverage(trusting, doubting)
    for _ in range(1000):
        average.see(np.zeros(3))
    assert average.doubt < 0.001
    doubting.log_likelihood = 5.0
    for _ in range(3):
        average.see(np.zeros(3))
    assert average.doubt > 0.9
    average.reset()
    assert average.doubt == pytest.approx(0.1)


def test_a_filter_that_fails_hands_over_the_base_estimate():
    average = ModelAverage(Told(3.0, 0.0), Told(math.nan, 0.0))
    assert average.update(SAMPLE).tip_deg == 3.0


@pytest.mark.parametrize("doubt", [0.0, 1.0, math.nan])
def test_a_doubt_that_no_image_could_change_is_refused(doubt):
    with pytest.raises(InvalidValue, match="doubt"):
        ModelAverage(Told(0.0, 0.0), Told(0.0, 0.0), doubt=doubt)
