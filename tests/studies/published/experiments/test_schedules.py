"""The paper's experiments as inputs."""

import numpy as np
import pytest

from studies.published.experiments.measurement import TurnExperiment
from studies.published.experiments.rig import WITH_FREE_LENGTH, WITHOUT_FREE_LENGTH
from studies.published.experiments.schedules import observed_s, schedule, step_s


def test_the_quick_turn_retracts_and_the_free_length_grows_by_what_is_retracted():
    inputs = schedule(TurnExperiment.QUICK_TURN, 50.0, WITH_FREE_LENGTH)
    assert np.all(inputs.speed_mm_s == -2.5)
    assert inputs.free_mm == pytest.approx(50.0 + 2.5 * inputs.time_s)
    assert (inputs.drive[0], inputs.drive[-1]) == (0.0, 90.0)


def test_without_free_length_none_grows():
    assert np.all(schedule(TurnExperiment.QUICK_TURN, 50.0, WITHOUT_FREE_LENGTH).free_mm == 0.0)


def test_the_slow_turn_is_at_rest_with_23_cm_free():
    inputs = schedule(TurnExperiment.SLOW_TURN, 50.0, WITHOUT_FREE_LENGTH)
    assert inputs.time_s == pytest.approx([0.0, 20.0])
    assert np.all(inputs.speed_mm_s == 0.0)
    assert np.all(inputs.free_mm == 230.0)


def test_a_release_retracts_by_5_mm_after_the_base_was_held_for_10_s():
    inputs = schedule(TurnExperiment.RELEASE, 50.0, WITH_FREE_LENGTH)
    moves = inputs.time_s[inputs.speed_mm_s != 0.0]
    assert (moves[0], moves[-1]) == pytest.approx((30.0, 31.0), abs=1e-5)
    assert inputs.free_mm[-1] - inputs.free_mm[0] == pytest.approx(5.0)


def test_a_quick_turn_is_observed_for_longer_where_it_is_deep():
    assert (observed_s(50.0), observed_s(200.0)) == pytest.approx((2.5, 6.0))


def test_slow_turns_have_longer_steps():
    slow, brisk, quick = map(
        step_s, (TurnExperiment.HELD_TURN, TurnExperiment.BRISK_TURN, TurnExperiment.QUICK_TURN)
    )
    assert max(brisk, quick) < slow
