"""Noise that is correlated from row to row."""

import numpy as np
import pytest
from scipy.signal import lfilter

from diagnosis.prepare.noise.colour_of_rows import ColourOfRows, even_rows
from diagnosis.prepare.noise.noise_colour import NoiseColour

STEP_S, KEPT = 0.01, 0.8
AT_STEPS = NoiseColour.of(share=1.0, correlation_time_s=-STEP_S / np.log(KEPT))
OF_ROWS = ColourOfRows(at_steps=AT_STEPS, step_s=STEP_S)


def uneven_times(rows, seed=0):
    return np.cumsum(STEP_S * np.random.default_rng(seed).uniform(0.5, 2.0, rows))


def test_a_filter_that_runs_once_a_row_is_undone_exactly():
    """The innovations of y <- 0.8 y + sqrt(1 - 0.8^2) e are e, at any times."""
    innovations = np.random.default_rng(1).normal(size=500)
    noise = lfilter([np.sqrt(1 - KEPT**2)], [1, -KEPT], innovations)
    found = OF_ROWS.whitened(uneven_times(500), noise)
    np.testing.assert_allclose(found[1:], innovations[1:], atol=1e-9)
    np.testing.assert_allclose(OF_ROWS.restored(uneven_times(500), found), noise, atol=1e-9)


def test_at_even_steps_it_is_the_same():
    values = np.random.default_rng(2).normal(size=(50, 3))
    even = even_rows(np.zeros(50), STEP_S)
    np.testing.assert_allclose(OF_ROWS.whitened(even, values), AT_STEPS.whitened(even, values))
    assert OF_ROWS.uncertainty(uneven_times(50)) == pytest.approx(AT_STEPS.uncertainty(even))


def test_it_says_that_it_is_of_rows():
    assert OF_ROWS.in_words == "over 45 ms, from row to row"
    assert OF_ROWS.numbers() == {**AT_STEPS.numbers(), "of_rows_s": STEP_S}
    assert OF_ROWS.share == 1.0


def test_means_over_windows_of_time_are_as_those_at_even_steps():
    assert OF_ROWS.of_means(0.25, 4 * STEP_S) == AT_STEPS.of_means(0.25, 4 * STEP_S)
