"""Motions of trials: lengths that fit together, and what an effect needs in order to show."""

import numpy as np
import pytest

from validation.logs.motions import FINEST_STEP_S, MOST_FREE_MM, LogPlan, draw_motions, draw_plan

SEEDS = range(25)


def drawn(seed, **shares):
    plan = LogPlan(trials=4, total_s=48.0, rate_hz=100, **shares)
    return draw_motions(np.random.default_rng(seed), plan)


@pytest.mark.parametrize("seed", SEEDS)
def test_the_free_length_is_what_the_axial_speed_makes_of_it(seed):
    """The trapezoidal rule, in which a log's speed and lengths agree, up to rounding."""
    for motion in drawn(seed, sliding=0.5, growing=0.5, loaded=0.5):
        speed = (motion.speed_mm_s[1:] + motion.speed_mm_s[:-1]) / 2
        assert np.diff(motion.free_mm) == pytest.approx(-speed * motion.dt_s, abs=1e-9)
        assert 0 < motion.free_mm.min() <= motion.free_mm.max() <= MOST_FREE_MM
        assert motion.inserted_mm.min() > 20
        if motion.growing:
            assert np.ptp(motion.inserted_mm + motion.free_mm) < 1e-9


@pytest.mark.parametrize("seed", SEEDS)
def test_a_trial_is_sampled_on_a_grid_that_is_fine_enough(seed):
    for motion in drawn(seed, sliding=0.0, growing=0.0, loaded=0.0):
        assert motion.dt_s <= FINEST_STEP_S
        assert motion.dt_s * motion.per_sample == pytest.approx(0.01)
        assert (motion.time_s.size - 1) % motion.per_sample == 0
        assert 9.9 <= motion.time_s[-1] <= 60.0


@pytest.mark.parametrize("seed", SEEDS)
def test_shares_of_sliding_growing_and_loaded_trials_are_kept(seed):
    motions = drawn(seed, sliding=0.5, growing=0.25, loaded=0.25)
    assert sum(motion.growing for motion in motions) == 1
    assert sum(motion.tip_torque_n_mm is not None for motion in motions) == 1
    assert sum(bool(motion.speed_mm_s.any()) for motion in motions) in (2, 3)
    still = drawn(seed, sliding=0.0, growing=0.0, loaded=0.0)
    assert not any(motion.speed_mm_s.any() or motion.growing for motion in still)


@pytest.mark.parametrize("seed", SEEDS)
def test_a_plan_gives_an_effect_what_it_needs_to_show(seed):
    plan = draw_plan(np.random.default_rng(seed), short=True, slides=True, loads=True)
    assert plan.sliding >= 0.7
    assert plan.loaded >= 0.7
    assert (plan.trials, plan.rate_hz in (50, 100)) == (3, True)
    assert 36 <= plan.total_s <= 44
    long = draw_plan(np.random.default_rng(seed), short=False, slides=False, loads=False)
    assert 3 <= long.trials <= 6
    assert 60 <= long.total_s <= 180
