"""A free law of a shaft that is stiffer one way than the other."""

import numpy as np
import pytest
from diagnosis_fixtures import turns
from free_forms import covered, same_readings

from diagnosis.freeform.families.shaft.wound import families
from diagnosis.replay.rig_parameters import NOMINAL, RigParameters

ANGLE = turns(6.0)
RANGES = covered(ANGLE, tip=ANGLE, torque=0.02 * ANGLE, seen=(ANGLE, 0.02 * ANGLE))


def test_without_a_torque_nothing_is_asked_of_the_shaft():
    assert families(covered(ANGLE, tip=ANGLE)) == ()


def test_one_that_is_as_much_stiffer_either_way_is_a_stiffer_one():
    (wound,) = families(RANGES)
    assert same_readings(
        ANGLE, wound.effect.apply(NOMINAL, 1.3, 1.3), RigParameters(stiffness_scale=1.3)
    )


@pytest.mark.parametrize("backwards", [0.5, 2.0])
def test_one_way_it_is_the_nominal_shaft_and_the_other_way_one_of_another_stiffness(backwards):
    (wound,) = families(RANGES)
    other = RigParameters(stiffness_scale=backwards)
    wound_up = np.maximum.accumulate(ANGLE)
    unwound = -wound_up
    one_way = wound.effect.apply(NOMINAL, 1.0, backwards)
    assert same_readings(wound_up, one_way, NOMINAL)
    assert same_readings(unwound, one_way, other)
    assert not same_readings(unwound, one_way, NOMINAL)


def test_its_curve_has_one_value_each_way():
    (wound,) = families(RANGES)
    torques, factors = wound.curve(1.5, 0.5)
    np.testing.assert_array_equal(factors, np.where(np.asarray(torques) > 0, 1.5, 0.5))
