"""The adaptive estimator learns the damping, also in noise, and refuses impossible noise."""

import math
from dataclasses import replace

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


def shown(recording, *, bias=0.0, seconds=None):
    """The samples of a recording, with a torque sensor that is off by a bias and has noise."""
    rng = np.random.default_rng(1)
    names = ("time_s", "base_angle_deg", "base_torque_n_mm", "inserted_mm", "free_mm")
    rows = np.array([recording[n] for n in names]).T
    kept = rows if seconds is None else rows[rows[:, 0] <= seconds]
    return [Sample(t, base, u + bias + rng.normal(0, 0.015), *ls) for t, base, u, *ls in kept]


def test_a_torque_that_is_shown_before_the_first_turn_is_taken_for_bias():
    estimator = AdaptiveEstimator(NITINOL, damping_n_mm_s_per_mm=BETA, bias_spread_n_mm=0.2)
    rng, n = np.random.default_rng(0), 100
    for i in range(n):
        estimator.update(Sample(0.002 * i, 0.0, 0.1 + rng.normal(0, 0.015), 100.0, 50.0))
    # The mean of n samples: four standard errors.
    assert estimator.torque_bias_n_mm == pytest.approx(0.1, abs=4 * 0.015 / math.sqrt(n))


@pytest.mark.parametrize("drift", [0.0, 0.002])
def test_a_bias_is_removed_from_the_estimate_of_the_tip(fast_turn, drift):
    estimator = AdaptiveEstimator(
        NITINOL, damping_n_mm_s_per_mm=BETA, bias_spread_n_mm=0.2, bias_drift_n_mm=drift
    )
    trusting = AdaptiveEstimator(NITINOL, damping_n_mm_s_per_mm=BETA)
    last = {}
    for name, one in (("estimated", estimator), ("trusted", trusting)):
        found = [one.update(sample) for sample in shown(fast_turn, bias=0.1)]
        tips = np.array([e.tip_deg for e in found[-500:]])
        last[name] = float(np.mean(tips - fast_turn["tip_angle_deg"][-500:]))
    # 0.1 N mm over 50 mm of free shaft alone are 0.9 deg.
    assert abs(last["trusted"]) > 0.9
    assert abs(last["estimated"]) < 0.1


def test_a_bias_that_comes_after_the_first_turn_is_followed_only_with_a_drift(fast_turn):
    """In viscous tissue: at rest, a torque that does not turn the base is no torque."""
    late = [
        replace(s, torque_n_mm=s.torque_n_mm + (0.1 if s.time_s > 2.0 else 0.0))
        for s in shown(fast_turn)
    ]
    found = {}
    for drift in (0.0, 0.1):
        estimator = AdaptiveEstimator(
            NITINOL, damping_n_mm_s_per_mm=BETA, bias_spread_n_mm=0.2, bias_drift_n_mm=drift
        )
        for sample in late:
            estimator.update(sample)
        found[drift] = estimator.torque_bias_n_mm
    assert found[0.1] == pytest.approx(0.1, abs=0.03)
    assert found[0.0] == pytest.approx(0.0, abs=0.03)


def test_a_torque_that_dry_friction_holds_is_taken_for_bias_where_the_bias_may_drift():
    """Not observable: base at rest, torque at rest, for ever. Only what was known before helps."""
    taken = {}
    for drift in (0.0, 0.1):
        estimator = AdaptiveEstimator(
            NITINOL, damping_n_mm_s_per_mm=BETA, bias_spread_n_mm=0.2, bias_drift_n_mm=drift
        )
        for i in range(2000):
            turned = min(0.02 * i, 20.0)
            estimator.update(Sample(0.002 * i, turned, 0.03 * turned, 100.0, 50.0))
        taken[drift] = estimator.torque_bias_n_mm
    assert taken[0.1] > 0.3  # of 0.6 N mm
    assert abs(taken[0.0]) < 0.01


@pytest.mark.parametrize("field", ["bias_spread_n_mm", "bias_drift_n_mm"])
@pytest.mark.parametrize("bad", [-0.1, math.inf])
def test_an_impossible_bias_is_refused_by_its_name(field, bad):
    with pytest.raises(InvalidValue, match=field):
        AdaptiveEstimator(NITINOL, damping_n_mm_s_per_mm=BETA, **{field: bad})


@pytest.mark.parametrize(
    "field", ["base_noise_deg", "torque_noise_n_mm", "guess_spread", "drift_per_s", "turn_noise_deg"]
)
@pytest.mark.parametrize("bad", [0.0, math.nan])
def test_an_impossible_noise_is_refused_by_its_name(field, bad):
    with pytest.raises(InvalidValue, match=field):
        AdaptiveEstimator(NITINOL, damping_n_mm_s_per_mm=BETA, **{field: bad})
