"""When a residual steps, against steps whose beginning is known."""

import numpy as np
import pytest

from diagnosis.residuals.step_time import step_of

TIME = np.arange(0, 12, 0.02)
NOISE = np.random.default_rng(5).normal(0, 0.2, TIME.size)


def following(at_s, lag_s, size):
    """What a needle with a time constant shows of a step."""
    since = np.maximum(TIME - at_s, 0.0)
    return size * (1.0 - np.exp(-since / lag_s)) if lag_s else size * (at_s < TIME)


@pytest.mark.parametrize("size", [5.0, -5.0])
@pytest.mark.parametrize("lag_s", [0.0, 0.3, 1.0])
@pytest.mark.parametrize("at_s", [2.0, 6.0, 9.0])
def test_a_step_begins_before_the_needle_has_followed(at_s, lag_s, size):
    """At a tenth of the way: 0.105 time constants after it; and a mean of five samples of 20 ms."""
    step = step_of(TIME, NOISE + following(at_s, lag_s, size))
    assert TIME[step.sample] == pytest.approx(at_s + 0.105 * lag_s, abs=0.1)


def test_the_gain_is_that_of_the_step_beside_a_mean():
    step = step_of(TIME, following(6.0, 0.0, 3.0))
    half = TIME.size / 2
    assert step.gain == pytest.approx(9.0 * half / 2, rel=0.01)


def test_a_trial_that_is_short_or_level_has_none():
    assert step_of(TIME[:40], NOISE[:40]) is None
    assert step_of(TIME, np.zeros(TIME.size)) is None


@pytest.mark.filterwarnings("error")
def test_a_step_in_a_gap_begins_at_the_first_reading_after_it():
    gap = (TIME > 4.0) & (TIME < 7.0)
    step = step_of(TIME[~gap], (NOISE + following(5.0, 0.3, 5.0))[~gap])
    assert TIME[~gap][step.sample] == pytest.approx(7.0, abs=0.02)
