"""What turns with the tip."""

import numpy as np
import pytest
from diagnosis_fixtures import RIG
from free_forms import VOCABULARY, covered

from diagnosis.freeform.families.in_one_place.inertia import families
from diagnosis.replay.rig_parameters import NOMINAL
from models import units

TIME = np.arange(0.0, 8.0, 0.01)
ANGLE = 40.0 * (1.0 - np.cos(np.pi * TIME))
TORQUE = 0.01 * ANGLE
(AT_TIP,) = families(covered(ANGLE, tip=ANGLE, torque=TORQUE, seen=(ANGLE, TORQUE)))


def test_without_torque_or_motion_nothing_is_told_of_it():
    assert families(covered(ANGLE, tip=ANGLE, seen=(ANGLE, 0.0 * ANGLE))) == ()
    assert families(covered(0.0 * ANGLE, torque=TORQUE, seen=(ANGLE, TORQUE))) == ()


def test_the_torque_is_proportional_to_the_acceleration_and_told_so():
    acceleration, torque = (np.array(own) for own in AT_TIP.curve(0.3))
    np.testing.assert_allclose(torque, 0.3 * acceleration)
    assert acceleration.max() == -acceleration.min() > 0.0
    assert AT_TIP.says in VOCABULARY
    (inertia,) = AT_TIP.effect.parameters
    assert all(inertia.low < start < inertia.high for start in inertia.start)
    assert inertia.towards_neutral(0.4, 0.5) == pytest.approx(0.2)


def test_a_mass_at_the_tip_adds_to_that_of_the_rig():
    law = AT_TIP.effect.apply(NOMINAL, 0.3)
    added = law.needle(RIG).tip_inertia_kg_m2 - NOMINAL.needle(RIG).tip_inertia_kg_m2
    assert added == pytest.approx(0.3 * units.N_MM)
    assert law.free.times(0.5).shaft.tip_inertia_kg_m2 == pytest.approx(0.5 * added)
