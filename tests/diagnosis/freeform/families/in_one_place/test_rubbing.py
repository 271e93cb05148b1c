"""Drag and dry friction at the entry, or in the sheath: without drag, effects of the library."""

import numpy as np
import pytest
from diagnosis_fixtures import turns
from free_forms import VOCABULARY, covered, same_readings

from diagnosis.effects import LIBRARY
from diagnosis.freeform.families.in_one_place.rubbing import SPOTS, families
from diagnosis.replay.rig_parameters import NOMINAL

ANGLE = turns(6.0)
FAMILIES = {family.name: family for family in families(covered(ANGLE, tip=ANGLE))}
LEVELS = {"entry torque": 0.1, "sheath torque": 0.001}
EACH = pytest.mark.parametrize("spot", SPOTS, ids=lambda spot: spot.name)


def rig_of(name, *values):
    return FAMILIES[name].effect.apply(NOMINAL, *values)


@EACH
def test_dry_friction_alone_is_that_of_the_library(spot):
    level = LEVELS[spot.name]
    dry = LIBRARY[spot.like].apply(NOMINAL, level)
    assert same_readings(ANGLE, rig_of(f"{spot.name} over rate", 0.0, level), dry)
    assert same_readings(ANGLE, rig_of(f"{spot.name} over direction", 0.0, level, 0.0), dry)
    assert not same_readings(ANGLE, rig_of(f"{spot.name} over rate", level, level), dry)
    assert not same_readings(ANGLE, rig_of(f"{spot.name} over direction", 0.0, level, 0.5), dry)


@EACH
def test_drag_and_friction_are_told_as_torques(spot):
    rates, torque = FAMILIES[f"{spot.name} over rate"].curve(0.2, 0.1)
    np.testing.assert_allclose(torque, 0.1 + 0.2 * rates)
    directions, torque = FAMILIES[f"{spot.name} over direction"].curve(0.0, 0.1, 0.4)
    assert directions == (-1.0, 1.0)
    np.testing.assert_allclose(torque, [0.06, 0.14])


def test_drag_alone_at_the_tip_is_that_of_the_library():
    drag = LIBRARY["tip_drag"].apply(NOMINAL, 0.2)
    assert same_readings(ANGLE, rig_of("tip torque over direction", 0.2, 0.0, 0.0), drag)
    assert not same_readings(ANGLE, rig_of("tip torque over direction", 0.2, 0.1, 0.0), drag)


def test_what_they_depend_on_has_a_word_and_all_start_with_some_drag():
    assert {family.says for family in FAMILIES.values()} == {"rate", "direction"} <= VOCABULARY
    for family in FAMILIES.values():
        damping, *others = family.effect.parameters
        assert min(damping.start) > 0
        assert {len(p.start) for p in others} == {len(damping.start)}
        assert damping.unit in ("N mm s / rad", "N mm s / rad / mm")
