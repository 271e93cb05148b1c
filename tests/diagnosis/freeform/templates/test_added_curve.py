"""A curve added to an angle or a reading: what it does to readings, its size and its units."""

import pytest
from diagnosis_fixtures import turns
from free_forms import covered, same_readings

from diagnosis.effects import IMPERFECTIONS, LIBRARY
from diagnosis.effects.effect import Place
from diagnosis.freeform.templates.added_curve import PAST_PLACES, AddedCurve, curve_of, family_of
from diagnosis.log.trial import TIP, TORQUE
from diagnosis.replay.curve import ActsOn
from diagnosis.replay.rig_parameters import NOMINAL
from diagnosis.replay.variables import Variable

ANGLE = turns(6.0)
LATE, TWIST = 0.8 * ANGLE, 0.01 * ANGLE
RANGES = covered(ANGLE, tip=LATE + 2.0, torque=TWIST + 0.3, seen=(LATE, TWIST))
SENSOR_OF = {ActsOn.TIP_READING: TIP, ActsOn.DRIVE_ANGLE: TIP, ActsOn.TORQUE_READING: TORQUE}


def family(acts_on, variable, **more):
    added = AddedCurve(
        acts_on=acts_on,
        variable=variable,
        sensor=SENSOR_OF[acts_on],
        places={Place.SENSOR: 1.0},
        title="error",
        says=variable,
        **more,
    )
    return family_of(added, curve_of(added, RANGES), RANGES)


def rig_of(one, *values):
    return one.effect.apply(NOMINAL, *values, *[0.0] * (len(one.effect.parameters) - len(values)))


def test_an_error_that_rises_with_the_reading_is_a_gain():
    """From end to end of the range of the nominal tip, a straight line through 0 with slope 0.1."""
    low, high = RANGES.ends["tip_angle"]
    middle, half = 0.05 * (high + low), 0.05 * (high - low)
    gained = LIBRARY["tip_angle_scale"].apply(NOMINAL, 1.1)
    found = rig_of(family(ActsOn.TIP_READING, Variable.TIP_ANGLE), middle, half)
    # Beyond the range of the nominal tip the curve is level: the simulated tip stays within it here.
    assert same_readings(0.5 * ANGLE, found, gained)


def test_all_of_the_torque_behind_a_time_constant_is_a_low_pass():
    past = family(ActsOn.TORQUE_READING, Variable.PAST)
    places, _ = past.curve(*[0.0] * PAST_PLACES)
    late = IMPERFECTIONS["torque_low_pass"].apply(NOMINAL, float(places[2]))
    assert same_readings(ANGLE, rig_of(past, 0.0, 0.0, 1.0), late)
    assert not same_readings(ANGLE, rig_of(past, 0.0, 1.0), late)


def test_coordinates_are_as_large_as_what_is_missing():
    assert RANGES.missing == pytest.approx({TIP: 2.0, TORQUE: 0.3})
    scale = {
        (acts_on, variable): family(acts_on, variable).effect.parameters[0].scale
        for acts_on in (ActsOn.TIP_READING, ActsOn.TORQUE_READING)
        for variable in (Variable.TIME, Variable.PAST)
    }
    assert scale == pytest.approx(
        {
            (ActsOn.TIP_READING, Variable.TIME): 2.0,
            (ActsOn.TORQUE_READING, Variable.TIME): 0.3,
            (ActsOn.TIP_READING, Variable.PAST): 1.0,  # a share
            (ActsOn.TORQUE_READING, Variable.PAST): 1.0,
        }
    )


@pytest.mark.parametrize(
    ("acts_on", "unit"),
    [(ActsOn.TORQUE_READING, "N mm"), (ActsOn.TIP_READING, "deg"), (ActsOn.DRIVE_ANGLE, "deg")],
)
def test_a_hysteresis_is_told_over_what_has_changed_since_it_turned_back(acts_on, unit):
    assert family(acts_on, Variable.TURNED_BY).x_unit == unit


def test_a_curve_that_repeats_says_after_how_much():
    once = family(ActsOn.TIP_READING, Variable.TIP_ANGLE, period_deg=360.0)
    assert once.name == "tip reading over tip_angle, every 360 deg"
    assert family(ActsOn.TIP_READING, Variable.TIP_ANGLE).name == "tip reading over tip_angle"
