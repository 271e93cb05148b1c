"""The signals that curves of a free law add."""

import numpy as np
import pytest

from diagnosis.replay.curve import ActsOn, Course, Curve
from diagnosis.replay.sensing.curve_signals import on_gain, on_needle, on_reading
from diagnosis.replay.variables import Variable
from sim.schedule import Schedule

TIME = np.arange(0, 10, 0.01)
ANGLE = 30.0 * np.sin(TIME)
TIP, TORQUE = 0.8 * ANGLE, 0.6 * np.cos(TIME)
PLACES, VALUES = (0.0, 1.0), (0.0, -2.0)
GROWS = Course(variable=Variable.TIME, places=(0.0, 10.0), values=(0.0, 2.0))
INPUTS = Schedule(
    time_s=TIME,
    drive=ANGLE,
    free_mm=60.0 - 2.0 * TIME,
    inserted_mm=90.0 + 2.0 * TIME,
    speed_mm_s=np.full(TIME.size, 2.0),
)


def curve(acts_on, variable, **more):
    return Curve(acts_on=acts_on, variable=variable, **({"places": PLACES, "values": VALUES} | more))


def read(own):
    return on_reading(own, INPUTS, 0.0, TIP, TIP, TORQUE)


@pytest.mark.parametrize(
    "variable", [Variable.PAST, Variable.TURNED_BY, Variable.TIP_ANGLE, Variable.TORQUE, Variable.RATE]
)
def test_what_a_reading_gets_is_multiplied_by_the_factor(variable):
    places = (0.1, 1.0) if variable in (Variable.PAST, Variable.TURNED_BY) else PLACES
    own = curve(ActsOn.TIP_READING, variable, places=places)
    grown = curve(ActsOn.TIP_READING, variable, places=places, factor=GROWS)
    np.testing.assert_allclose(read(grown), 0.2 * TIME * read(own), atol=1e-12)
    assert np.ptp(read(own)) > 0.0


@pytest.mark.parametrize(
    "variable",
    [Variable.TURNED_BY, Variable.ADVANCED_BY, Variable.PAST, Variable.TORQUE, Variable.BASE_ANGLE],
)
def test_and_so_is_what_the_needle_gets(variable):
    places = (0.1, 1.0)
    own = curve(ActsOn.DRIVE_ANGLE, variable, places=places)
    grown = curve(ActsOn.DRIVE_ANGLE, variable, places=places, factor=GROWS)
    without = on_needle(own, INPUTS, 0.0, TORQUE)
    np.testing.assert_allclose(on_needle(grown, INPUTS, 0.0, TORQUE), 0.2 * TIME * without, atol=1e-12)
    assert np.ptp(without) > 0.0


def test_hysteresis_of_a_bearing_is_over_the_drive_and_of_a_sensor_over_what_it_reads():
    bearing, sensor = (
        read(curve(acts_on, Variable.TURNED_BY, places=(1.0, 2.0)))
        for acts_on in (ActsOn.DRIVE_TORQUE, ActsOn.TIP_READING)
    )
    own = curve(ActsOn.DRIVE_TORQUE, Variable.TURNED_BY, places=(1.0, 2.0))
    np.testing.assert_array_equal(bearing, own.with_hysteresis(ANGLE))
    np.testing.assert_array_equal(sensor, own.with_hysteresis(TIP))


def test_a_reading_may_be_held_by_what_it_reads():
    own = curve(ActsOn.TIP_READING, Variable.HELD_BY, values=(0.0, 5.0))
    shown = TIP + read(own)
    np.testing.assert_allclose(shown, TIP + own.held(TIP))
    assert np.unique(shown).size < 40 < np.unique(TIP).size
    assert np.abs(read(own)).max() == pytest.approx(5.0, abs=0.3)  # a sample moves by 0.24 at most


def test_a_gain_adds_its_excess_over_one():
    own = curve(ActsOn.TIP_GAIN, Variable.TIME, values=(1.5, 1.5))
    np.testing.assert_allclose(on_gain(own, INPUTS, 0.0, TIP), 0.5 * TIP)
