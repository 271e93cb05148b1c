"""Free laws of a joint in the shaft: without play, and where it is stiff, it is none."""

import numpy as np
from diagnosis_fixtures import turns
from free_forms import covered, same_readings

from diagnosis.freeform.families.shaft.joint import families
from diagnosis.replay.rig_parameters import NOMINAL

ANGLE = turns(6.0)
RANGES = covered(ANGLE, tip=ANGLE, torque=0.02 * ANGLE, seen=(ANGLE, 0.02 * ANGLE))


def test_without_a_torque_nothing_is_asked_of_the_shaft():
    assert families(covered(ANGLE, tip=ANGLE)) == ()


def test_a_joint_without_play_is_none():
    joint, _ = families(RANGES)
    assert same_readings(ANGLE, joint.effect.apply(NOMINAL, 0.0, 40.0), NOMINAL)
    here, there = (joint.effect.apply(NOMINAL, 5.0, at_mm) for at_mm in (20.0, 100.0))
    assert not same_readings(ANGLE, here, NOMINAL)
    assert not same_readings(ANGLE, here, there)
    places, play = joint.curve(5.0, 40.0)
    assert (np.interp(39.0, places, play), np.interp(42.0, places, play)) == (0.0, 5.0)


def test_a_spring_that_twists_as_no_shaft_does_is_none():
    _, spring = families(RANGES)
    assert same_readings(ANGLE, spring.effect.apply(NOMINAL, 0.0, 40.0), NOMINAL)
    here, there = (spring.effect.apply(NOMINAL, 60.0, at_mm) for at_mm in (20.0, 100.0))
    assert not same_readings(ANGLE, here, NOMINAL)
    assert not same_readings(ANGLE, here, there)
    places, twist = spring.curve(60.0, 40.0)
    assert (np.interp(39.0, places, twist), np.interp(42.0, places, twist)) == (0.0, 60.0)
