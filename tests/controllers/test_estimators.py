"""Estimators: against closed forms and the MuJoCo needle, and in trouble."""

import math

import numpy as np
import pytest
from estimated_runs import BETA, estimates, worst

from controllers.estimators import FeedforwardEstimator, LuenbergerEstimator, OutputEquation
from controllers.signals import Sample, Status
from models.errors import InvalidValue
from models.needle import NITINOL


def feedforward(**fields):
    return FeedforwardEstimator(NITINOL, **({"damping_n_mm_s_per_mm": BETA} | fields))


def test_the_tip_is_known_from_base_and_torque_alone(fast_turn):
    # 3 modes and the static tail: what is truncated lags by less than 0.1 deg of 90.
    assert worst(fast_turn, estimates(fast_turn, feedforward())) < 0.15


@pytest.mark.parametrize("order", [2, 3, 6, 10])
def test_any_order_works_and_more_is_not_worse_than_two(fast_turn, order):
    error = worst(fast_turn, estimates(fast_turn, feedforward(order=order)))
    assert error < (1.5 if order == 2 else 0.2)


def test_the_observer_corrects_what_is_left(fast_turn):
    observer = LuenbergerEstimator(NITINOL, damping_n_mm_s_per_mm=BETA)
    assert worst(fast_turn, estimates(fast_turn, observer, tip=True)) < 0.02


def test_the_observers_poles_are_five_times_faster():
    observer = LuenbergerEstimator(NITINOL, damping_n_mm_s_per_mm=BETA, order=6)
    a = -np.diag(observer.twist.squares[observer._observed])
    closed = np.linalg.eigvals(a - observer._unit_gain @ observer._row)
    assert np.sort(closed.real) == pytest.approx(np.sort(5 * np.diag(a)), rel=1e-6)


def test_the_papers_output_equation_costs_tens_of_degrees(fast_turn):
    series = worst(fast_turn, estimates(fast_turn, feedforward()))
    paper = worst(fast_turn, estimates(fast_turn, feedforward(output=OutputEquation.PAPER)))
    assert paper > 30 > 100 * series


def test_the_modes_are_carried_over_while_the_needle_goes_in(insertion):
    assert worst(insertion, estimates(insertion, feedforward())) < 0.1


GOOD = Sample(0.0, 1.0, 0.1, 100.0, 50.0)


@pytest.mark.parametrize(
    "bad",
    [
        Sample(0.1, math.nan, 0.1, 100.0, 50.0),
        Sample(0.1, 1.0, math.inf, 100.0, 50.0),
        Sample(0.1, 1.0, 0.1, -1.0, 50.0),
        Sample(0.1, 1.0, 0.1, 100.0, 50.0, math.nan),
    ],
)
def test_after_a_bad_sample_the_last_estimate_is_held_and_says_so(bad):
    estimator = feedforward()
    before = estimator.update(GOOD)
    held = estimator.update(bad)
    assert held.status is Status.BAD_SAMPLE
    assert held.tip_deg == before.tip_deg
    after = estimator.update(Sample(0.2, 1.0, 0.1, 100.0, 50.0))
    assert after.status is Status.OK


@pytest.mark.parametrize("time", [0.0, -1.0])
def test_time_that_does_not_go_on_is_refused_in_the_loop(time):
    estimator = feedforward()
    estimator.update(GOOD)
    assert estimator.update(Sample(time, 5.0, 0.1, 100.0, 50.0)).status is Status.BAD_TIME


def test_outside_the_tissue_the_tip_is_where_the_base_is():
    estimate = feedforward().update(Sample(0.0, 42.0, 0.0, 0.0, 150.0))
    assert estimate.status is Status.OUTSIDE
    assert estimate.tip_deg == 42.0


def test_reset_forgets(fast_turn):
    estimator = feedforward()
    first = [e.tip_deg for e in estimates(fast_turn, estimator)]
    estimator.reset()
    assert [e.tip_deg for e in estimates(fast_turn, estimator)] == first


@pytest.mark.parametrize(
    ("make", "field"),
    [
        (lambda: feedforward(damping_n_mm_s_per_mm=0.0), "damping"),
        (lambda: feedforward(damping_n_mm_s_per_mm=math.nan), "damping"),
        (lambda: feedforward(order=1), "order"),
        (lambda: LuenbergerEstimator(NITINOL, damping_n_mm_s_per_mm=BETA, speed=0.5), "speed"),
    ],
)
def test_an_impossible_estimator_is_refused_at_construction(make, field):
    with pytest.raises(InvalidValue, match=field):
        make()
