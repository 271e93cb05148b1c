"""A tip sensor whose error has the sign of the rate."""

import numpy as np
import pytest
from diagnosis_fixtures import turns
from free_forms import VOCABULARY, covered, same_readings

from diagnosis.freeform.families.sensors.stepping import families
from diagnosis.replay.rig_parameters import NOMINAL

ANGLE = turns(6.0)
(FAMILY,) = families(covered(ANGLE, tip=0.8 * ANGLE + 1.0, seen=(0.8 * ANGLE, 0.0 * ANGLE)))


def test_the_error_is_a_step_of_the_rate():
    rig = FAMILY.effect.apply(NOMINAL, 3.0, 0.1)
    (curve,) = rig.free.curves
    rates = np.linspace(-1.0, 1.0, 201)
    # Eight places either side of rest, straight between them within a cubic: 2 % of the height.
    np.testing.assert_allclose(curve.at(rates), 3.0 * np.tanh(rates / 0.1), atol=0.06)


def test_without_a_height_it_is_the_nominal_rig():
    width = FAMILY.effect.parameters[1].start[0]
    assert same_readings(ANGLE, FAMILY.effect.apply(NOMINAL, 0.0, width), NOMINAL)
    assert not same_readings(ANGLE, FAMILY.effect.apply(NOMINAL, 2.0, width), NOMINAL)


def test_what_it_depends_on_has_a_word_and_its_starts_are_within_bounds():
    assert FAMILY.says == "direction"
    assert FAMILY.says in VOCABULARY
    height, width = FAMILY.effect.parameters
    assert len(height.start) == len(width.start)
    assert {np.sign(start) for start in height.start} == {-1.0, 1.0}
    assert all(p.low <= s <= p.high for p in FAMILY.effect.parameters for s in p.start)
    assert height.towards_neutral(2.0, 0.5) == pytest.approx(1.0)


def test_a_tip_that_is_not_read_or_does_not_turn_tells_nothing():
    assert families(covered(ANGLE, torque=ANGLE, seen=(ANGLE, 0.9 * ANGLE))) == ()
    assert families(covered(0.0 * ANGLE, tip=0.0 * ANGLE + 1.0, seen=(0.0 * ANGLE, 0.0 * ANGLE))) == ()
