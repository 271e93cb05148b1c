"""Free laws of the shaft's material in time: where they are small, it is the nominal one."""

import numpy as np
from diagnosis_fixtures import turns
from free_forms import covered, same_readings

from diagnosis.freeform.families.shaft.in_time import families
from diagnosis.replay.rig_parameters import NOMINAL
from models.needle import NITINOL

ANGLE = turns(6.0)
RANGES = covered(ANGLE, tip=ANGLE, torque=0.02 * ANGLE, seen=(ANGLE, 0.02 * ANGLE))
FAMILIES = {f.name: f for f in families(RANGES)}


def test_without_a_torque_nothing_is_asked_of_the_shaft():
    assert families(covered(ANGLE, tip=ANGLE)) == ()


def test_damping_of_the_material_is_that_of_the_needle_and_hardly_any_is_none():
    damps = FAMILIES["damping of the shaft over rate"]
    rig = damps.effect.apply(NOMINAL, 0.2)
    assert rig.free.needle(NITINOL).damping_time_s == 0.2
    assert rig.free.times(0.5).shaft.damping_time_s == 0.1
    per_s, torque = damps.curve(0.2)
    np.testing.assert_allclose(torque, 1.0 + 0.2 * per_s)
    assert same_readings(ANGLE, damps.effect.apply(NOMINAL, 1e-9), NOMINAL)
    assert not same_readings(ANGLE, rig, NOMINAL)


def test_creep_twists_a_shaft_further_by_its_ratio_in_the_end():
    creeps = FAMILIES["creep of the shaft over past"]
    at_s, twist = creeps.curve(0.5, 2.0)
    assert twist[0] == 1.0
    np.testing.assert_allclose(twist, 1.0 + 0.5 * (1.0 - np.exp(-at_s / 2.0)))
    assert same_readings(ANGLE, creeps.effect.apply(NOMINAL, 1e-9, 2.0), NOMINAL)
    assert not same_readings(ANGLE, creeps.effect.apply(NOMINAL, 0.5, 2.0), NOMINAL)
