"""The autoregression of noise, from residuals that also hold what a model lacks."""

import numpy as np
import pytest
from scipy.signal import butter, lfilter, sosfilt

from diagnosis.prepare.noise.spectrum.autoregression_fit import autoregression

RATE_HZ, SIZE = 100, 2000


def trials(shaped, seed=1, size=SIZE, count=4):
    rng = np.random.default_rng(seed)
    each = [shaped(rng.normal(size=size + 500))[500:] for _ in range(count)]
    scale = np.std(np.concatenate(each))
    return [(np.arange(size) / RATE_HZ, values / scale) for values in each]


def swings(white):
    return lfilter([1], [1, -1.5, 0.8], white)


def band(order, cut):
    sections = butter(order, cut, output="sos")
    return lambda white: sosfilt(sections, white) + 0.02 * white[::-1]


def white_level(parts, found, block):
    """Of whitened noise: standard deviation, and that of means of blocks, scaled."""
    sigma, own = found
    left = [own.whitened(time_s, values / sigma) for time_s, values in parts]
    means = np.concatenate([part.reshape(-1, block).mean(axis=1) for part in left])
    return np.concatenate(left).std(), np.sqrt(block) * means.std()


def test_a_process_of_second_order_is_found():
    sigma, found = autoregression(trials(swings))
    np.testing.assert_allclose(found.coefficients[:2], [1.5, -0.8], atol=0.05)
    assert sigma == pytest.approx(1.0, abs=0.1)
    assert found.coefficients.size <= 4


@pytest.mark.parametrize(("order", "cut"), [(4, 0.3), (4, 0.6), (2, 0.3)])
def test_noise_of_a_band_is_white_once_its_past_is_known(order, cut):
    """8000 samples: s to 1 / sqrt(16 000), with a quantile half as good, and 3 sigma; means of 320."""
    parts = trials(band(order, cut))
    whole, slow = white_level(parts, autoregression(parts), 25)
    assert whole == pytest.approx(1.0, abs=0.04)
    assert slow == pytest.approx(1.0, abs=0.15)


def test_what_is_slow_is_no_noise():
    """A relaxation every 5 s, of twice the noise: more than that, and no autoregression is asked for."""
    parts = trials(swings)
    slow = [(t, values + 2 * np.exp(-(t % 5.0))) for t, values in parts]
    _, without = autoregression(parts)
    sigma, found = autoregression(slow)
    assert sigma == pytest.approx(1.0, abs=0.1)
    np.testing.assert_allclose(found.coefficients[:2], without.coefficients[:2], atol=0.1)


def test_white_noise_has_none():
    assert autoregression(trials(lambda white: white)) is None


def test_too_little_or_uneven_steps_tell_none():
    assert autoregression([]) is None
    assert autoregression(trials(swings, count=1, size=600)) is None
    one, other = trials(swings, count=2)
    assert autoregression([one, (2.0 * other[0], other[1])]) is None


def test_a_trial_in_which_nothing_was_read_tells_nothing():
    parts = trials(swings)
    time_s, values = parts[0]
    unread = (time_s, np.full_like(values, np.nan))
    assert autoregression([unread, *parts]) == autoregression(parts)
