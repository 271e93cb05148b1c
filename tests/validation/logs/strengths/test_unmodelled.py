"""Draws of effects outside the library: events are of one trial, strengths of one parameter."""

import numpy as np
import pytest

from validation.logs.motions import LEAST_TRIALS
from validation.logs.strengths.unmodelled import UNMODELLED_FAMILIES

EVENTS = ("chuck_jump", "tip_sensor_jump")


@pytest.mark.parametrize("name", EVENTS)
def test_an_event_is_well_within_a_trial_that_every_log_has(name):
    drawn = [UNMODELLED_FAMILIES[name].draw(np.random.default_rng(i))(5.0) for i in range(60)]
    assert {p["trial"] for p in drawn} == {*range(LEAST_TRIALS)}
    assert all(0.2 <= p["share"] <= 0.6 for p in drawn)
    assert {p["angle"] for p in drawn} == {-5.0, 5.0}


@pytest.mark.parametrize("name", UNMODELLED_FAMILIES)
def test_the_strength_moves_one_parameter_and_leaves_the_shape(name):
    family = UNMODELLED_FAMILIES[name]
    by_strength = family.draw(np.random.default_rng(2))
    weak, strong = by_strength(family.low), by_strength(family.high)
    assert sum(weak[parameter] != strong[parameter] for parameter in weak) == 1
    assert 0 < family.low < family.high
