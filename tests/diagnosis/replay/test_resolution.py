"""How finely a replay cuts needle and time."""

import pytest
from diagnosis_fixtures import prepared, trial, turns

from diagnosis.replay.resolution import COARSE, FINE, Resolution
from sim.discretisation import LONGEST_STEP_S


def test_a_step_is_never_longer_than_a_sample():
    rare, often = (
        prepared(trial(turns(step=0.03), step=0.03)),
        prepared(trial(turns(step=0.002), step=0.002)),
    )
    assert FINE.step_of(rare) == FINE.step_s
    assert FINE.step_of(often) == pytest.approx(0.002)
    assert COARSE.step_of(rare) == pytest.approx(0.03)


def test_coarse_is_coarser():
    assert COARSE.elements < FINE.elements
    assert COARSE.step_s > FINE.step_s


def test_half_as_fine_is_so_where_samples_limit_the_step_and_where_they_do_not():
    rare, often = (
        prepared(trial(turns(step=0.03), step=0.03)),
        prepared(trial(turns(step=0.002), step=0.002)),
    )
    assert FINE.halved.elements == FINE.elements / 2
    for one in (rare, often):
        assert FINE.halved.step_of(one) == pytest.approx(2 * FINE.step_of(one))


def test_no_step_is_longer_than_a_simulation_takes():
    slow = Resolution(elements=6, step_s=0.08)
    assert slow.halved.step_s == LONGEST_STEP_S < 2 * slow.step_s
