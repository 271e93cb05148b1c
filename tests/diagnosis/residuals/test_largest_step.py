"""The step that takes most off a cost, against least squares with a column for each step."""

import numpy as np
import pytest

from diagnosis.residuals.largest_step import largest_step

BLOCKS = (slice(0, 60), slice(60, 150))


@pytest.fixture
def fit():
    """Residual and slopes of a fit, which leaves nothing along its slopes."""
    rng = np.random.default_rng(2)
    slopes = np.column_stack([np.linspace(-1, 1, 155), rng.normal(size=(155, 2))])
    left = rng.normal(size=155)
    left[100:150] += 2.0
    return left - slopes @ np.linalg.lstsq(slopes, left)[0], slopes


def test_it_is_the_best_of_all_steps_by_least_squares(fit):
    left, slopes = fit
    taken = {}
    for number, block in enumerate(BLOCKS):
        for sample in range(10, block.stop - block.start - 10):
            step = np.zeros(left.size)
            step[block.start + sample : block.stop] = 1.0
            system = np.column_stack([slopes, step])
            rest = left - system @ np.linalg.lstsq(system, left)[0]
            taken[number, sample] = float(left @ left - rest @ rest)
    found = largest_step(left, slopes, BLOCKS, 10)
    assert (found.block, found.sample) == max(taken, key=taken.get)
    assert found.gain == pytest.approx(max(taken.values()))


def test_the_step_that_is_there_is_found(fit):
    found = largest_step(*fit, BLOCKS, 10)
    assert found.block == 1
    assert found.sample == pytest.approx(40, abs=2)


def test_no_step_is_looked_for_at_the_ends(fit):
    assert largest_step(*fit, BLOCKS, 45) is None


def test_what_the_fit_can_do_itself_is_no_step(fit):
    left, slopes = fit
    step = np.zeros(left.size)
    step[100:150] = 1.0
    with_step = np.column_stack([slopes, step])
    rest = left - with_step @ np.linalg.lstsq(with_step, left)[0]
    found = largest_step(rest, with_step, (slice(100, 150),), 0)
    assert found.gain < 20  # noise alone: of 50 steps the largest chi-square of one
