"""The adaptive estimator learns the damping, also in noise, and refuses impossible noise."""

import math

import numpy as np
import pytest
from estimated_runs import BETA, estimates, worst

from controllers.adaptive import AdaptiveEstimator
from controllers.estimators import FeedforwardEstimator
from controllers.signals import Sample
from models.errors import InvalidValue
from models.needle import NITINOL


@pytest.mark.parametrize("wrong", [0.5, 1.5])
def test_the_adaptive_estimator_learns_the_damping(fast_turn, wrong):
    fixed = FeedforwardEstimator(NITINOL, damping_n_mm_s_per_mm=wrong * BETA)
    learning = AdaptiveEstimator(NITINOL, damping_n_mm_s_per_mm=wrong * BETA)
    found = estimates(fast_turn, learning)
    assert found[-1].damping_n_mm_s_per_mm == pytest.approx(BETA, rel=0.02)
    lost = worst(fast_turn, estimates(fast_turn, fixed))
    assert worst(fast_turn, found) < 0.2 * lost  # most of the loss is recovered


def test_with_noise_the_adaptive_estimator_still_learns(fast_turn):
    rng = np.random.default_rng(0)
    noisy = fast_turn.table.copy()
    noisy["base_angle_deg"] += rng.normal(0, 0.02, len(noisy))
    noisy["base_torque_n_mm"] += rng.normal(0, 0.015, len(noisy))
    estimator = AdaptiveEstimator(NITINOL, damping_n_mm_s_per_mm=1.5 * BETA)
    names = ["time_s", "base_angle_deg", "base_torque_n_mm", "inserted_mm", "free_mm"]
    found = [estimator.update(Sample(*row)) for row in noisy[names].itertuples(index=False)]
    # One turn of 90 deg against an allowed drift of 0.3 deg in a root second: some per cent.
    assert found[-1].damping_n_mm_s_per_mm == pytest.approx(BETA, rel=0.1)


def test_a_fixed_estimator_does_not_learn(fast_turn):
    """Negative control."""
    fixed = FeedforwardEstimator(NITINOL, damping_n_mm_s_per_mm=1.5 * BETA)
    assert estimates(fast_turn, fixed)[-1].damping_n_mm_s_per_mm == 1.5 * BETA


def test_reset_returns_to_the_first_guess(fast_turn):
    estimator = AdaptiveEstimator(NITINOL, damping_n_mm_s_per_mm=1.5 * BETA)
    first = [e.tip_deg for e in estimates(fast_turn, estimator)[:1500]]
    estimator.reset()
    assert estimator.damping == 1.5 * BETA
    assert [e.tip_deg for e in estimates(fast_turn, estimator)[:1500]] == first


@pytest.mark.parametrize(
    "field", ["base_noise_deg", "torque_noise_n_mm", "guess_spread", "drift_per_s", "turn_noise_deg"]
)
@pytest.mark.parametrize("bad", [0.0, math.nan])
def test_an_impossible_noise_is_refused_by_its_name(field, bad):
    with pytest.raises(InvalidValue, match=field):
        AdaptiveEstimator(NITINOL, damping_n_mm_s_per_mm=BETA, **{field: bad})
