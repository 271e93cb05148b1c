"""What all curves of a law together make of the inputs of a needle and of its readings."""

import numpy as np
import pytest

from diagnosis.replay.curve import ActsOn, Curve
from diagnosis.replay.sensing.curve_sums import OF_SENSORS, driven_by, readings_by
from diagnosis.replay.variables import Variable
from sim.schedule import Schedule

TIME = np.arange(0, 10, 0.01)
TIP, TORQUE = 20.0 * np.sin(TIME), 0.1 * np.cos(TIME)
PLACES, VALUES = (0.0, 2.0, 3.0, 8.0), (1.0, 1.0, 4.0, 2.0)
INPUTS = Schedule(
    time_s=TIME,
    drive=30.0 * TIME,
    free_mm=np.full(TIME.size, 60.0),
    inserted_mm=np.full(TIME.size, 90.0),
    speed_mm_s=np.zeros(TIME.size),
)


def curve(acts_on, values=VALUES):
    return Curve(acts_on=acts_on, variable=Variable.TIME, places=PLACES, values=values)


def driven(*curves):
    return driven_by(curves, INPUTS, 0.0, TORQUE)


def changed(done):
    inputs = ("drive", "free_mm", "inserted_mm", "tip_torque_n_mm", "tissue_factor")
    return {name for name in inputs if np.any(getattr(done, name) != getattr(INPUTS, name))}


@pytest.mark.parametrize("acts_on", OF_SENSORS)
def test_what_acts_on_sensors_leaves_the_inputs_as_they_are(acts_on):
    assert changed(driven(curve(acts_on))) == set()


@pytest.mark.parametrize(
    ("acts_on", "inputs"),
    [
        (ActsOn.DRIVE_ANGLE, {"drive"}),
        (ActsOn.TISSUE_ANGLE, {"drive"}),
        (ActsOn.TISSUE_SLIP, {"drive"}),
        (ActsOn.DRIVE_SLIP, {"drive"}),
        (ActsOn.TIP_TORQUE, {"tip_torque_n_mm"}),
        (ActsOn.TISSUE, {"tissue_factor"}),
        (ActsOn.STIFFNESS, {"tissue_factor"}),
        (ActsOn.ORIENTATION, {"tissue_factor"}),
        (ActsOn.INSERTED_LENGTH, {"free_mm", "inserted_mm"}),
        (ActsOn.FREE_LENGTH, {"free_mm"}),
    ],
)
def test_what_acts_on_the_needle_changes_its_own_input(acts_on, inputs):
    assert changed(driven(curve(acts_on))) == inputs


def test_the_same_twice_is_added_or_multiplied():
    angle, factor = curve(ActsOn.DRIVE_ANGLE), curve(ActsOn.TISSUE)
    done = driven(angle, angle, factor, factor)
    np.testing.assert_allclose(done.drive, INPUTS.drive + 2.0 * angle.at(TIME))
    np.testing.assert_allclose(done.tissue_factor, factor.at(TIME) ** 2)


def test_a_rate_of_slip_takes_from_the_drive_what_it_adds_up_to():
    slipped = driven(curve(ActsOn.DRIVE_SLIP, values=(2.0,) * 4)).drive - INPUTS.drive
    np.testing.assert_allclose(slipped, -2.0 * TIME, atol=1e-9)


def test_a_shaft_that_gives_is_slower_by_as_much_in_tissue_that_resists_as_before():
    soft = driven(curve(ActsOn.STIFFNESS, values=(0.5,) * 4))
    np.testing.assert_allclose(soft.tissue_factor, 2.0)


def test_tissue_keeps_a_little_and_no_more_is_inserted_than_is_free():
    small = driven(curve(ActsOn.TISSUE, values=(1e-9,) * 4))
    assert small.tissue_factor.min() == pytest.approx(1e-3)
    for most in (1e3, -1e3):
        done = driven(curve(ActsOn.INSERTED_LENGTH, values=(most,) * 4))
        np.testing.assert_allclose(done.inserted_mm + done.free_mm, 150.0)
        np.testing.assert_allclose(done.inserted_mm, 150.0 if most > 0 else 0.0)


def test_a_free_length_is_never_less_than_none():
    done = driven(curve(ActsOn.FREE_LENGTH, values=(-1e3,) * 4))
    np.testing.assert_array_equal(done.free_mm, 0.0)
    longer = driven(curve(ActsOn.FREE_LENGTH, values=(5.0,) * 4))
    np.testing.assert_allclose(longer.free_mm, INPUTS.free_mm + 5.0)
    np.testing.assert_array_equal(longer.inserted_mm, INPUTS.inserted_mm)


def test_counts_that_are_lost_at_a_rate_add_up_at_the_tip():
    tip, torque = readings_by([curve(ActsOn.TIP_COUNTS, values=(3.0,) * 4)], INPUTS, 0.0, TIP, TORQUE)
    np.testing.assert_allclose(tip, 3.0 * TIME, atol=1e-9)
    assert not torque.any()


def test_the_tip_sensor_shows_the_tissue_that_turns():
    own = curve(ActsOn.TISSUE_ANGLE)
    tip, torque = readings_by([own], INPUTS, 0.0, TIP, TORQUE)
    np.testing.assert_allclose(tip, own.at(TIME))
    assert not torque.any()
