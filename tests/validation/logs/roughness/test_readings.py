"""Roughness of readings: the memory of the noise, the grid of the steps, the number of outliers."""

import numpy as np
import pytest

from validation.logs.roughness.readings import coloured_noise, first_order, outliers, quantisation
from validation.logs.sensors import BASE, MEASURED, TIP, TORQUE

SEEDS = range(60)


def autocorrelation(values):
    values = values - values.mean()
    return float(values[1:] @ values[:-1] / (values @ values))


def test_noise_of_first_order_keeps_its_variance_and_has_its_memory():
    """AR(1): lag 1 correlates with a = exp(-0.01 / 0.05); of 10^5 samples it is known to 0.002."""
    times = np.arange(100_000) * 0.01
    noise = first_order(times, np.random.default_rng(1).normal(0, 2.0, times.size), 0.05)
    a = np.exp(-0.2)
    assert autocorrelation(noise) == pytest.approx(a, abs=0.008)
    # Its variance is that of N (1 - a) / (1 + a) independent samples: 4 sigma are 3 %.
    assert noise.std() == pytest.approx(2.0, rel=0.03)


def test_where_samples_are_missing_the_memory_fades():
    """A second is twenty times the time constant: nothing is left of the noise before it."""
    times = np.array([0.0, 0.01, 1.01])
    noise = first_order(times, np.array([1.0, 0.0, 0.0]), 0.05)
    assert noise == pytest.approx([1.0, np.exp(-0.2), np.exp(-20.2)])


def test_coloured_noise_has_the_claimed_size_and_the_drawn_memory(drawn, recorded, sensors):
    """Of 10 001 samples with a memory of some tens, the standard deviation is known to about 4 %."""
    one = drawn(coloured_noise, signals=[TIP, TORQUE], share_of_variance=1.0)
    (columns,) = recorded(one)
    expected = np.exp(-0.01 / one.numbers["time_constant_s"])
    for signal in MEASURED:
        assert columns[signal].std() == pytest.approx(sensors.noise[signal], rel=0.15)
        assert autocorrelation(columns[signal]) == pytest.approx(expected, abs=0.03)
    assert abs(autocorrelation(columns[BASE])) < 0.04


def test_white_noise_beside_the_coloured_one_lowers_the_correlation(drawn, recorded):
    """By its share of the variance, at every lag."""
    for seed in SEEDS:
        one = coloured_noise(np.random.default_rng(seed))
        if one.numbers["share_of_variance"] < 1 and TIP in one.numbers["signals"]:
            break
    (columns,) = recorded(one)
    expected = one.numbers["share_of_variance"] * np.exp(-0.01 / one.numbers["time_constant_s"])
    assert autocorrelation(columns[TIP]) == pytest.approx(expected, abs=0.05)


def test_correlations_at_100_hz_are_those_of_a_lab():
    drawn = [coloured_noise(np.random.default_rng(seed)).numbers for seed in SEEDS]
    correlations = [np.exp(-0.01 / numbers["time_constant_s"]) for numbers in drawn]
    assert 0.36 < min(correlations) < 0.5
    assert 0.9 < max(correlations) < 0.952
    assert {tuple(numbers["signals"]) for numbers in drawn} == {(TIP,), (TORQUE,), (TIP, TORQUE)}


@pytest.mark.parametrize("seed", range(8))
def test_quantised_readings_are_whole_steps(recorded, sensors, seed):
    one = quantisation(np.random.default_rng(seed))
    (columns,) = recorded(one)
    steps = {name: size * sensors.noise[name] for name, size in one.numbers["steps_sigma"].items()}
    if "base_step_deg" in one.numbers:
        steps[BASE] = one.numbers["base_step_deg"]
        assert 0.1 <= steps[BASE] <= 0.5
    assert steps
    assert all(1 <= size <= 5 for size in one.numbers["steps_sigma"].values())
    for signal, step in steps.items():
        assert columns[signal] / step == pytest.approx(np.round(columns[signal] / step), abs=1e-9)


@pytest.mark.parametrize("doubled", [0.0, 0.3])
def test_outliers_are_as_many_and_as_far_off_as_drawn(drawn, recorded, sensors, doubled):
    """Noise stays below 5 sigma; of n expected ones the number is known to sqrt(n (1 + doubled))."""
    one = drawn(outliers, signals=[TIP], two_in_a_row=doubled)
    (columns,) = recorded(one)
    clean = recorded(seed=0)[0]
    off = np.abs(columns[TIP] - clean[TIP]) / sensors.noise[TIP]
    hit = off > 1e-9
    assert off[hit].min() >= 5
    assert off[hit].max() <= 100
    expected = one.numbers["share"] * off.size
    assert hit.sum() == pytest.approx(expected, abs=5 * np.sqrt(expected))
    in_a_row = hit[1:] & hit[:-1] & (np.abs(np.diff(columns[TIP] - clean[TIP])) < 1e-9)
    assert in_a_row.any() == (doubled > 0)
    assert (columns[TORQUE] == clean[TORQUE]).all()


def test_the_base_has_outliers_sometimes():
    """In 20 % of 60 draws: 12 with a standard deviation of 3."""
    drawn = [outliers(np.random.default_rng(seed)).numbers for seed in SEEDS]
    assert 1 <= sum(BASE in numbers["signals"] for numbers in drawn) <= 24
    assert all(0.002 <= numbers["share"] <= 0.02 for numbers in drawn)
