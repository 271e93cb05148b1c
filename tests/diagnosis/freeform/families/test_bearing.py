"""Dry friction in the drive that changes with the angle, the depth, the axial speed or the time."""

import numpy as np
import pytest
from diagnosis_fixtures import turns
from free_forms import VOCABULARY, covered, same_readings

from diagnosis.effects import LIBRARY
from diagnosis.effects.effect import Place
from diagnosis.freeform.families.bearing import families
from diagnosis.replay.rig_parameters import NOMINAL

ANGLE = turns(6.0)
TORQUE = 0.01 * ANGLE
FAMILIES = {f.name: f for f in families(covered(ANGLE, torque=TORQUE + 0.3, seen=(0.8 * ANGLE, TORQUE)))}
ONCE_A_TURN = "bearing friction over base_angle, every 360 deg"


def rig_of(name, *values):
    family = FAMILIES[name]
    flat = [0.0] * (len(family.effect.parameters) - len(values))
    return family.effect.apply(NOMINAL, *values, *flat)


@pytest.mark.parametrize("name", list(FAMILIES))
def test_a_level_of_nothing_is_the_nominal_rig_and_an_even_one_that_of_the_library(name):
    even = LIBRARY["drive_friction"].apply(NOMINAL, 0.2)
    assert same_readings(ANGLE, rig_of(name), NOMINAL)
    assert same_readings(ANGLE, rig_of(name, 0.2), even)


@pytest.mark.parametrize("name", list(FAMILIES))
def test_what_it_depends_on_has_a_word(name):
    family = FAMILIES[name]
    assert family.says in VOCABULARY
    assert max(family.places, key=lambda place: family.places[place]) is Place.DRIVE
    assert sum(family.places.values()) == pytest.approx(1.0)


def test_a_shaft_that_binds_in_a_part_of_its_turn_has_friction_there_alone():
    family = FAMILIES[ONCE_A_TURN]
    rng = np.random.default_rng(1)
    c = rng.normal(size=len(family.effect.parameters))
    places, levels = (np.array(own) for own in family.curve(*c))
    (curve,) = family.effect.apply(NOMINAL, *c).free.curves
    np.testing.assert_allclose(curve.factor.at(places), levels)
    np.testing.assert_allclose(curve.factor.at(places + 720.0), levels)
    np.testing.assert_array_equal(curve.at(np.array([-1.0, 0.0, 1.0])), [-1.0, 0.0, 1.0])


def test_without_torque_or_motion_of_the_drive_nothing_is_told_of_it():
    assert families(covered(ANGLE, tip=ANGLE)) == ()
    assert families(covered(0.0 * ANGLE, torque=TORQUE, seen=(ANGLE, 0.0 * ANGLE))) == ()
