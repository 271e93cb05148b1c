"""Noise that is correlated in time or from row to row, told by which is likelier."""

import numpy as np
import pytest
from scipy.signal import lfilter

from diagnosis.prepare.noise.colour_of_rows import ColourOfRows
from diagnosis.prepare.noise.noise_colour import NoiseColour
from diagnosis.prepare.noise.spectrum.time_or_rows import colour_in_time_or_rows

STEP_S, MEMORY_S, ROWS = 0.01, 0.05, 4000


def uneven_times(seed):
    """Steps of 5 to 15 ms."""
    return np.cumsum(STEP_S * np.random.default_rng(seed).uniform(0.5, 1.5, ROWS))


def of_rows(time_s, seed):
    kept = np.exp(-STEP_S / MEMORY_S)
    return lfilter([np.sqrt(1 - kept**2)], [1, -kept], np.random.default_rng(seed).normal(size=ROWS))


def in_time(time_s, seed):
    """An Ornstein-Uhlenbeck process of variance 1, step by step."""
    draws, kept = np.random.default_rng(seed).normal(size=ROWS), np.exp(-np.diff(time_s) / MEMORY_S)
    values = [draws[0]]
    for own, draw in zip(kept, draws[1:], strict=True):
        values.append(own * values[-1] + np.sqrt(1 - own**2) * draw)
    return np.array(values)


def found_in(noise, times=uneven_times):
    return colour_in_time_or_rows([(times(seed), noise(times(seed), seed)) for seed in (1, 2)])


def test_noise_of_rows_is_told_with_its_size():
    """8000 rows, each correlated over 5: a standard deviation to 1 / sqrt(2 x 800) = 2.5 %."""
    sigma, colour = found_in(of_rows)
    assert isinstance(colour, ColourOfRows)
    assert sigma == pytest.approx(1.0, abs=4 * 0.025)
    assert colour.numbers()["correlation_time_s"] == pytest.approx(MEMORY_S, rel=0.3)


def test_noise_in_time_is_not_taken_for_it():
    sigma, colour = found_in(in_time)
    assert isinstance(colour, NoiseColour)
    assert sigma == pytest.approx(1.0, abs=4 * 0.025)


def test_at_even_steps_there_is_nothing_to_tell():
    _, colour = found_in(of_rows, times=lambda seed: STEP_S * np.arange(ROWS))
    assert isinstance(colour, NoiseColour)


def test_white_noise_has_no_colour():
    assert found_in(lambda time_s, seed: np.random.default_rng(seed).normal(size=ROWS)) is None


def test_readings_that_are_missing_are_no_rows():
    times, holes = uneven_times(1), np.random.default_rng(5).uniform(size=ROWS) < 0.2
    values = np.full(ROWS, np.nan)
    values[~holes] = of_rows(times, 1)[: (~holes).sum()]
    _, colour = colour_in_time_or_rows([(times, values)])
    assert isinstance(colour, ColourOfRows)
