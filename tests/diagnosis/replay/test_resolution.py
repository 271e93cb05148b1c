"""How finely a replay cuts needle and time."""

import pytest
from diagnosis_fixtures import prepared, trial, turns

from diagnosis.replay.resolution import COARSE, FINE, Resolution
from sim.discretisation import LONGEST_STEP_S


def test_a_step_is_whole_samples_or_a_part_of_one():
    each = [prepared(trial(turns(step=step), step=step)) for step in (0.03, 0.008, 0.005, 0.002)]
    assert [FINE.step_of(one) for one in each] == pytest.approx([0.01, 0.008, 0.01, 0.01])
    assert COARSE.step_of(each[0]) == pytest.approx(0.03)


def test_coarse_is_coarser():
    assert COARSE.elements < FINE.elements
    assert COARSE.step_s > FINE.step_s


def test_half_as_fine_is_so_where_samples_limit_the_step_and_where_they_do_not():
    each = [prepared(trial(turns(step=step), step=step)) for step in (0.04, 0.01, 0.005)]
    assert FINE.halved.elements == FINE.elements / 2
    for one in each:
        assert FINE.halved.step_of(one) == pytest.approx(2 * FINE.step_of(one))
    assert FINE.refined.halved == FINE


def test_no_step_is_longer_than_a_simulation_takes():
    slow = Resolution(elements=6, step_s=0.08)
    assert slow.halved.step_s == LONGEST_STEP_S < 2 * slow.step_s


def test_nearer_the_usual_is_half_as_fine_down_to_what_logs_are_replayed_with():
    assert FINE.refined.nearer_the_usual == FINE
    assert FINE.nearer_the_usual == FINE
    assert COARSE.nearer_the_usual == COARSE
    long = Resolution(elements=48, step_s=FINE.step_s)
    assert long.nearer_the_usual == Resolution(elements=24, step_s=FINE.step_s)
