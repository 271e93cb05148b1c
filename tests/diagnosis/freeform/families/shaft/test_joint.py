"""Free laws of a joint in the shaft: without play, and where it is stiff, it is none."""

import numpy as np
import pytest
from diagnosis_fixtures import turns
from free_forms import covered, same_readings

from diagnosis.freeform.families.shaft.joint import families
from diagnosis.replay.rig_parameters import NOMINAL

ANGLE = turns(6.0)
RANGES = covered(ANGLE, tip=ANGLE, torque=0.02 * ANGLE, seen=(ANGLE, 0.02 * ANGLE))


def test_without_a_torque_nothing_is_asked_of_the_shaft():
    assert families(covered(ANGLE, tip=ANGLE)) == ()


@pytest.mark.parametrize(("law", "size"), [(0, 5.0), (1, 60.0)])
def test_without_play_or_where_it_is_stiff_a_joint_is_none(law, size):
    joint = families(RANGES)[law]
    assert same_readings(ANGLE, joint.effect.apply(NOMINAL, 0.0, 40.0), NOMINAL)
    here, there = (joint.effect.apply(NOMINAL, size, at_mm) for at_mm in (20.0, 100.0))
    assert not same_readings(ANGLE, here, NOMINAL)
    assert not same_readings(ANGLE, here, there)
    places, beyond = joint.curve(size, 40.0)
    assert (np.interp(39.0, places, beyond), np.interp(42.0, places, beyond)) == (0.0, size)
