"""What every model of a noise's colour does with readings of any shape."""

import numpy as np
import pytest

from diagnosis.prepare.noise.autoregression import Autoregression
from diagnosis.prepare.noise.colour import Colour
from diagnosis.prepare.noise.noise_colour import NoiseColour

TIME_S = 0.01 * np.arange(50)
MODELS = [
    NoiseColour.of(share=0.7, correlation_time_s=0.05),
    Autoregression(autocovariances=(1.0, 0.8, 0.5), step_s=0.01),
]


@pytest.mark.parametrize("model", MODELS)
def test_columns_are_whitened_each_by_itself_and_keep_their_shape(model):
    values = np.random.default_rng(1).normal(size=(TIME_S.size, 3))
    found = model.whitened(TIME_S, values)
    for i in range(3):
        np.testing.assert_allclose(model.whitened(TIME_S, values[:, i]), found[:, i], rtol=1e-12)
    np.testing.assert_allclose(model.restored(TIME_S, found), values, atol=1e-10)


@pytest.mark.parametrize("model", MODELS)
@pytest.mark.parametrize("shape", [(0, 3), (0,)])
def test_no_reading_is_none_in_the_same_shape(model, shape):
    assert model.whitened(np.zeros(0), np.zeros(shape)).shape == shape
    assert model.uncertainty(np.zeros(0)) == 0.0


@pytest.mark.parametrize("model", MODELS)
def test_a_report_has_its_share_words_and_numbers(model):
    assert 0.0 < model.share < 1.0
    assert "ms" in model.in_words
    assert model.numbers()["correlation_time_s"] > 0.0
    assert isinstance(model.numbers()["parts"], list)


def test_a_model_has_to_say_all_of_it():
    """A filter alone is no model of a colour: its share, words, numbers and means are missing."""

    class FilterAlone(Colour):
        def _filtered(self, time_s, columns, *, restored):
            return columns, 0.0

    with pytest.raises(TypeError, match="abstract"):
        FilterAlone()
    assert all(isinstance(model, Colour) for model in MODELS)
