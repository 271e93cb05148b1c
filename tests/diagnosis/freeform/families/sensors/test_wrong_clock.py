"""Clocks that are off by more than clocks are."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import turns
from free_forms import VOCABULARY, covered, same_readings

from diagnosis.effects import IMPERFECTIONS
from diagnosis.effects.effect import Place
from diagnosis.freeform.families.sensors.wrong_clock import families
from diagnosis.replay.rig_parameters import NOMINAL

ANGLE = turns(6.0)
ALL = families(covered(ANGLE, tip=ANGLE, torque=ANGLE))
TIP, TORQUE, BOTH = ALL


@pytest.mark.parametrize(("family", "clock"), [(TIP, "tip_clock"), (TORQUE, "torque_clock")])
def test_a_clock_of_one_sensor_is_the_imperfection_beyond_its_bounds(family, clock):
    imperfection = IMPERFECTIONS[clock]
    assert same_readings(ANGLE, family.effect.apply(NOMINAL, 0.01), imperfection.apply(NOMINAL, 0.01))
    assert family.effect.parameters[0].high > imperfection.parameters[0].high
    assert not same_readings(ANGLE, family.effect.apply(NOMINAL, 0.1), NOMINAL)


def test_a_clock_of_the_base_is_off_against_both_sensors():
    rig = BOTH.effect.apply(NOMINAL, 0.05)
    assert (rig.tip_clock_ratio, rig.torque_clock_ratio) == (1.05, 1.05)
    assert {*BOTH.places} == {Place.SENSOR, Place.DRIVE}


def test_it_adds_to_a_clock_that_the_rig_has():
    rig = replace(NOMINAL, tip_clock_ratio=1.01)
    assert TIP.effect.apply(rig, 0.05).tip_clock_ratio == pytest.approx(1.06)


@pytest.mark.parametrize("family", ALL, ids=lambda one: one.effect.name)
def test_without_a_rate_it_is_nothing_and_its_curve_is_the_time_that_it_is_ahead(family):
    assert same_readings(ANGLE, family.effect.apply(NOMINAL, 0.0), NOMINAL)
    assert family.says == "time"
    assert family.says in VOCABULARY
    time_s, ahead_s = (np.array(own) for own in family.curve(0.04))
    assert time_s[-1] == pytest.approx(ANGLE.size * 0.01, abs=0.02)
    np.testing.assert_allclose(ahead_s, 0.04 * time_s)


def test_a_sensor_that_was_not_read_has_no_clock():
    (alone,) = families(covered(ANGLE, tip=ANGLE))
    assert alone.effect.name == TIP.effect.name
