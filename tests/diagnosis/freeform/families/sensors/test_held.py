"""A sensor that shows a new value only once that is far from what it shows."""

import numpy as np
import pytest
from diagnosis_fixtures import turns
from free_forms import VOCABULARY, covered, same_readings

from diagnosis.freeform.families.sensors.held import families
from diagnosis.replay.rig_parameters import NOMINAL
from diagnosis.replay.sensing.held_reading import held_back

ANGLE = turns(6.0)
TORQUE = 0.02 * ANGLE
HELD_DEG, HELD_N_MM = 7.0, 0.2
FAMILIES = families(
    covered(
        ANGLE,
        tip=ANGLE + held_back(ANGLE, HELD_DEG),
        torque=TORQUE + held_back(TORQUE, HELD_N_MM),
        seen=(ANGLE, TORQUE),
    )
)
TIP, GAUGE = FAMILIES


@pytest.mark.parametrize(("family", "held"), [(TIP, HELD_DEG), (GAUGE, HELD_N_MM)])
def test_fits_start_from_the_distance_at_which_nominal_readings_are_those_of_the_log(family, held):
    """The grid is finer than 2 %."""
    (distance,) = family.effect.parameters
    assert distance.start[0] == pytest.approx(held, rel=0.02)
    ratios = [max(a, b) / min(a, b) for i, a in enumerate(distance.start) for b in distance.start[:i]]
    assert min(ratios) > 1.1
    assert all(distance.low < start < distance.high for start in distance.start)


@pytest.mark.parametrize(("family", "far"), [(TIP, 10.0), (GAUGE, 0.1)])
def test_a_reading_that_is_held_within_no_distance_is_the_nominal_one(family, far):
    assert same_readings(ANGLE, family.effect.apply(NOMINAL, 1e-12), NOMINAL)
    assert not same_readings(ANGLE, family.effect.apply(NOMINAL, far), NOMINAL)


def test_a_law_of_half_the_strength_holds_within_half_the_distance():
    free = TIP.effect.apply(NOMINAL, 4.0).free
    assert free.times(0.5) == TIP.effect.apply(NOMINAL, 2.0).free


def test_the_law_is_told_over_how_far_a_value_is_from_what_is_shown():
    off, change = TIP.curve(5.0)
    shown = np.interp([2.0, 4.99, 5.01, 9.0], off, change)
    np.testing.assert_allclose(shown, [0.0, 0.0, 5.0, 5.0])
    assert {family.says for family in FAMILIES} == {"history"} <= VOCABULARY


def test_of_sensors_those_that_were_read_may_hold():
    assert [f.name for f in families(covered(ANGLE, torque=TORQUE + 1.0, seen=(ANGLE, TORQUE)))] == [
        GAUGE.name
    ]
