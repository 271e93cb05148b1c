"""Drag and dry friction in one place that change: times a level curve they are those that do not."""

import numpy as np
import pytest
from diagnosis_fixtures import turns
from free_forms import VOCABULARY, covered, same_readings

from diagnosis.freeform.families.in_one_place import rubbing
from diagnosis.freeform.families.in_one_place.rubbing_over import families
from diagnosis.replay.rig_parameters import NOMINAL

ANGLE = turns(6.0)
SLIDING = covered(ANGLE, tip=ANGLE, speed=2.0 * np.sin(np.linspace(0, 9, ANGLE.size)))
FAMILIES = {family.name: family for family in families(SLIDING)}
LEVELS = {"entry torque": (0.05, 0.1), "sheath torque": (0.0005, 0.001)}
STEADY = {family.name: family for family in rubbing.families(SLIDING)}


@pytest.mark.parametrize("name", FAMILIES)
def test_a_torque_that_is_always_the_same_is_the_one_that_does_not_change(name):
    family, spot = FAMILIES[name], name.split(" over ")[0]
    flat = [0.0] * (len(family.effect.parameters) - 2)
    steady = STEADY[f"{spot} over rate"].effect.apply(NOMINAL, *LEVELS[spot])
    own, twice = (family.effect.apply(NOMINAL, *LEVELS[spot], *c) for c in (flat, [0.7, *flat[1:]]))
    assert same_readings(ANGLE, own, steady)
    assert not same_readings(ANGLE, twice, steady)


@pytest.mark.parametrize("name", FAMILIES)
def test_it_is_told_at_a_slow_rate(name):
    family = FAMILIES[name]
    flat = [0.0] * (len(family.effect.parameters) - 2)
    _, torque = family.curve(1.0, 0.1, *flat)
    np.testing.assert_allclose(torque, 0.1 + 0.03)
    assert family.says in VOCABULARY


def test_of_a_needle_that_neither_slides_nor_turns_the_time_is_left():
    still = families(covered(0.1 * ANGLE, tip=ANGLE))
    assert {family.name for family in still} == {"entry torque over time", "sheath torque over time"}
