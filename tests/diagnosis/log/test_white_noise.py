"""White noise of a signal, told by its differences."""

from math import comb

import numpy as np
import pytest
from scipy import integrate, signal, stats

from diagnosis.log import white_noise as owner
from diagnosis.log.white_noise import white_noise

ORDERS = (1, 2, 4)


def moment(power, end):
    """Mean of min(|z|, end)^power of a standard normal z."""
    clipped = integrate.quad(lambda z: min(z, end) ** power * stats.norm.pdf(z), 0, 40, points=[end])
    return 2 * clipped[0]


def spread(order, samples):
    """Standard deviation of the estimate over its value: no more than chance and correlation give.

    The mean square of the central share p of N normal values varies as min(z^2, q^2) / p does, where q
    is the quantile: 1 / sqrt(2 N) of its root for p = 1. Differences of order k correlate over j
    samples by rho = binom(2k, k + j) / binom(2k, k), their squares by rho^2, which leaves fewer of them.
    """
    share = owner._CENTRAL_SHARE[order]
    end = stats.norm.ppf((1 + share) / 2) if share < 1 else 40.0
    mean, fourth = moment(2, end), moment(4, end)
    within = 2 * integrate.quad(lambda z: z**2 * stats.norm.pdf(z), 0, end)[0]
    rho = [comb(2 * order, order + j) / comb(2 * order, order) for j in range(-order, order + 1)]
    return 0.5 * np.sqrt((fourth - mean**2) / samples * np.sum(np.square(rho))) / within


def test_chance_is_that_of_a_normal_deviation_where_all_differences_count():
    """von Neumann: the mean square of first differences of N values has a variance of 3 / N."""
    assert spread(1, 1000) == pytest.approx(np.sqrt(1.5 / 2000), rel=1e-3)


@pytest.mark.parametrize("order", ORDERS)
def test_white_noise_is_measured(order):
    parts = np.random.default_rng(order).normal(0, 0.3, (3, 4000))
    assert white_noise(list(parts), order=order) == pytest.approx(0.3, rel=4 * spread(order, 12_000))


@pytest.mark.parametrize("order", ORDERS)
def test_the_central_root_mean_square_is_that_of_a_truncated_normal_distribution(order):
    share = owner._CENTRAL_SHARE[order]
    end = stats.norm.ppf((1 + share) / 2)
    closed = stats.truncnorm(-end, end).std() if share < 1 else 1.0
    # The constants are given to four digits.
    assert owner._CENTRAL_RMS[order] == pytest.approx(closed, rel=1e-4)


@pytest.mark.parametrize("order", [2, 4])
def test_slow_motion_is_no_noise(order):
    """White noise alone, and the same under a swing of a hundred times its size."""
    noise = np.random.default_rng(1).normal(0, 0.3, 4000)
    slow = 30 * np.sin(np.linspace(0, 20, 4000))
    # Second differences of the swing are 30 (20 / 4000)^2 = 0.00075 at the most: 0.1 % of noise's 0.73.
    alone = white_noise([noise], order=order)
    assert white_noise([noise + slow], order=order) == pytest.approx(alone, rel=1e-3)
    assert white_noise([slow], order=order) < 0.001


def test_fast_motion_in_a_tenth_of_the_samples_is_ignored_by_second_differences():
    noise = np.random.default_rng(2).normal(0, 0.3, 4000)
    turns = noise + np.cumsum(np.where(np.arange(4000) % 100 == 50, 20.0, 0.0))  # jumps: 2 % of each
    # Of the smaller 90 %, what jumps displace is 2 % further out: below 4 % of the estimate.
    assert white_noise([turns], order=2) == pytest.approx(0.3, rel=0.04 + 4 * spread(2, 4000))
    assert np.std(np.diff(turns, 2)) > 3 * np.std(np.diff(noise, 2))


@pytest.mark.parametrize("step", [0.2, 0.35])
def test_noise_is_measured_through_quantisation(step):
    """A quantised reading scatters by sigma and by step / sqrt(12)."""
    rng = np.random.default_rng(3)
    time = np.linspace(0, 60, 6000)
    values = step * np.round((30 * np.sin(time) + rng.normal(0, 0.3, time.size)) / step)
    # Equal steps make ties at the edge of the central share, a few per cent of the differences.
    assert white_noise([values], order=4) == pytest.approx(np.hypot(0.3, step / np.sqrt(12)), rel=0.05)


@pytest.mark.parametrize("order", ORDERS)
def test_too_few_readings_tell_nothing(order):
    noise = np.random.default_rng(4).normal(size=20 + order)
    assert np.isfinite(white_noise([noise], order=order))
    assert np.isnan(white_noise([noise[:-1]], order=order))
    assert np.isnan(white_noise([], order=order))


def test_gaps_are_left_out():
    noise = np.random.default_rng(5).normal(size=3000)
    read = np.where(np.arange(3000) % 3 == 0, np.nan, noise)
    assert white_noise([read], order=1) == white_noise([noise[np.isfinite(read)]], order=1)


@pytest.mark.parametrize("order", ORDERS)
def test_white_noise_is_measured_over_uneven_times(order):
    """Beside a motion that differences over even times would take for noise."""
    rng = np.random.default_rng(order)
    at = np.cumsum(0.01 + rng.uniform(-0.004, 0.004, 12_000))
    moving = 0.02 * 0.3 * at if order == 1 else 600.0 * at  # first differences leave a slope
    read = moving + rng.normal(0, 0.3, at.size)
    found = white_noise([read], order=order, times_s=[at])
    # Weights vary from window to window, which leaves the same chance.
    assert found == pytest.approx(0.3, rel=4 * spread(order, 12_000))
    if order > 1:
        assert white_noise([read], order=order) > 0.5


def test_over_even_times_differences_are_those_of_binomials():
    read = np.random.default_rng(9).normal(0, 0.3, 500)
    for order in ORDERS:
        known = white_noise([read], order=order, times_s=[0.01 * np.arange(500)])
        assert known == pytest.approx(white_noise([read], order=order), rel=1e-9)


def test_times_belong_to_their_readings():
    with pytest.raises(ValueError, match="zip"):
        white_noise([np.zeros(30)], order=2, times_s=[np.arange(30.0)] * 2)


@pytest.mark.parametrize("degrees", [3, 5, 1000])
def test_heavy_tails_are_measured_beside_the_core(degrees):
    """First differences of Student's t, whose density is that of t convolved with itself."""
    grid = np.linspace(-200, 200, 80_001)
    one = stats.t.pdf(grid, degrees)
    density = np.maximum(signal.fftconvolve(one, one, "same"), 0) * (grid[1] - grid[0])
    share = np.cumsum(density) * (grid[1] - grid[0])
    core = np.abs(grid) <= grid[np.searchsorted(share, 0.875)]
    variance = np.sum((grid**2 * density)[core]) / np.sum(density[core])
    ratio = np.sqrt(2 * degrees / (degrees - 2) / variance) * owner._CORE_RMS
    noise = np.random.default_rng(1).standard_t(degrees, size=400_000)
    # The variance of t with 3 degrees of freedom converges slowly; the others' to 1 in 600.
    assert owner.heaviness([noise]) == pytest.approx(ratio, rel=0.05 if degrees == 3 else 0.01)


def test_neither_jumps_nor_what_a_model_lacks_are_heavy_tails():
    rng = np.random.default_rng(2)
    noise = rng.normal(size=4000)
    jumps = 15 * (np.arange(4000) // 500 % 2)
    assert owner.heaviness([noise + jumps]) < 1.05
    hump = 12 * np.exp(-(((np.arange(4000) - 2000) / 150) ** 2))
    assert owner.heaviness([noise + hump]) < 1.05
