"""What clocks that run off by another rate in each trial take off the cost of a fit."""

import math

import numpy as np
import pytest
from diagnosis_fixtures import fit_of

from diagnosis.selection.candidate import candidate
from diagnosis.selection.scoring.complexity import complexity_penalty
from diagnosis.selection.scoring.own_values import gain_of_own_values

TRIALS, ROWS = 4, 500
RNG = np.random.default_rng(5)
SLOPES = [RNG.normal(size=(ROWS, 1)) for _ in range(TRIALS)]
NOISE = [RNG.normal(size=ROWS) for _ in range(TRIALS)]


def clock(rates, name="tip_clock"):
    """The fit of one rate to readings of a clock with these rates, by trial, and noise."""
    left = [noise - own[:, 0] * rate for noise, own, rate in zip(NOISE, SLOPES, rates, strict=True)]
    (x, *_), *_ = np.linalg.lstsq(np.vstack(SLOPES), -np.concatenate(left))
    by_trial = [r + own[:, 0] * x for r, own in zip(left, SLOPES, strict=True)]
    return fit_of([name], by_trial=by_trial, jacobian=SLOPES, x=[0.0])


def test_of_one_rate_nothing_is_gained():
    assert gain_of_own_values(clock([0.3] * TRIALS)) == 0.0


def test_of_other_rates_it_is_what_they_take_off_less_what_they_cost():
    rates = np.array([0.0, 0.5, 1.0, 1.5])
    squares = np.array([float(own[:, 0] @ own[:, 0]) for own in SLOPES])
    apart = rates - squares @ rates / squares.sum()
    expected = squares @ apart**2 - (TRIALS - 1) * math.log(1.0 + TRIALS * ROWS)
    # The noise adds a term of standard deviation 2 sqrt(squares @ apart^2), 50.
    assert gain_of_own_values(clock(rates)) == pytest.approx(expected, abs=3.5 * 50)
    assert expected > 500


def test_what_is_one_thing_in_all_trials_may_not_differ():
    assert gain_of_own_values(clock([0.0, 0.5, 1.0, 1.5], name="tip_sensor_delay")) == 0.0


def test_of_one_trial_nothing_differs():
    fit = fit_of(["tip_clock"], by_trial=NOISE[:1], jacobian=SLOPES[:1], x=[0.0])
    assert gain_of_own_values(fit) == 0.0


def test_a_candidate_is_scored_by_it():
    fit = clock([0.0, 0.5, 1.0, 1.5])
    expected = fit.cost + complexity_penalty(fit) - gain_of_own_values(fit)
    assert candidate(fit).score == pytest.approx(expected)
