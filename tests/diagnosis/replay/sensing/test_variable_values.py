"""What a free law may depend on, against motions whose variables are known."""

from dataclasses import replace

import numpy as np
import pytest

from diagnosis.replay.sensing.variable_values import RESTED_S, SLID_S, of_inputs, of_needle
from diagnosis.replay.variables import OF_THE_NEEDLE, Variable
from sim.discretisation import PRESLIDING_DEG
from sim.schedule import Schedule

STEP_S = 0.01
TIME = np.arange(0, 8, STEP_S)
ANGLE = np.interp(TIME, [0, 1, 2, 4, 5], [0, 0, 90, 90, 30])  # forwards, a rest, backwards
RATES_DEG_S = {0.5: 0.0, 1.5: 90.0, 3.0: 0.0, 4.5: -60.0, 7.0: 0.0}


def inputs(angle=ANGLE, before_s=0.0):
    """Inserted at 2 mm/s from 40 mm on."""
    return Schedule(
        time_s=TIME - before_s,
        drive=angle,
        free_mm=60.0 - 2.0 * TIME,
        inserted_mm=40.0 + 2.0 * TIME,
        speed_mm_s=np.full(TIME.size, 2.0),
    )


def at(variable, when_s, **changed):
    return np.interp(when_s, TIME, of_inputs(variable, inputs(**changed), 0.0))


def test_every_variable_is_known_before_or_after_the_simulation():
    before = set(Variable) - {
        *OF_THE_NEEDLE,
        Variable.PAST,
        Variable.TURNED_BY,
        Variable.ADVANCED_BY,
        Variable.LAG,
        Variable.HELD_BY,
    }
    assert all(of_inputs(v, inputs(), 0.0).shape == TIME.shape for v in before)


def test_time_begins_with_the_trial():
    late = of_inputs(Variable.TIME, inputs(before_s=3.0), 1.0)
    np.testing.assert_allclose(late, TIME - 4.0)


def test_a_share_of_the_trial_is_0_at_its_start_and_1_at_its_end():
    share = of_inputs(Variable.TRIAL_SHARE, inputs(), 0.0)
    np.testing.assert_allclose(share, TIME / TIME[-1])
    later = of_inputs(Variable.TRIAL_SHARE, inputs(before_s=3.0), 1.0)
    assert (later[400], later[-1]) == (pytest.approx(0.0), 1.0)


def test_what_is_logged_is_as_logged():
    for variable, own in (
        (Variable.BASE_ANGLE, ANGLE),
        (Variable.AXIAL_SPEED, np.full(TIME.size, 2.0)),
        (Variable.DEPTH, 40.0 + 2.0 * TIME),
    ):
        np.testing.assert_array_equal(of_inputs(variable, inputs(), 0.0), own)


@pytest.mark.parametrize(("when_s", "deg_s"), RATES_DEG_S.items())
def test_the_rate_is_that_of_the_drive_shaft(when_s, deg_s):
    assert at(Variable.RATE, when_s) == pytest.approx(np.radians(deg_s), abs=1e-9)


@pytest.mark.parametrize(
    ("when_s", "direction"), [(0.1, 1.0), (1.5, 1.0), (3.0, 1.0), (4.5, -1.0), (7.5, -1.0)]
)
def test_the_direction_is_that_of_the_last_turn_and_before_the_first_of_that(when_s, direction):
    assert at(Variable.DIRECTION, when_s) == pytest.approx(direction)


@pytest.mark.parametrize(
    ("when_s", "direction"), [(0.1, 0.0), (1.5, 1.0), (3.0, 1.0), (4.5, -1.0), (7.5, -1.0)]
)
def test_the_direction_of_sliding_is_none_before_the_first_turn(when_s, direction):
    assert at(Variable.SLID_DIRECTION, when_s) == pytest.approx(direction)


def test_dry_friction_reaches_a_direction_over_its_presliding_angle():
    turned_deg = 0.5 * PRESLIDING_DEG * np.minimum(TIME / TIME[-1], 1.0)
    values = of_inputs(Variable.SLID_DIRECTION, inputs(angle=turned_deg), 0.0)
    np.testing.assert_allclose(values, turned_deg / PRESLIDING_DEG, atol=1e-9)


def test_a_turn_that_gains_speed_evenly_has_one_acceleration():
    values = of_inputs(Variable.ACCELERATION, inputs(angle=np.degrees(0.5 * 0.8 * TIME**2)), 0.0)
    np.testing.assert_allclose(values[5:-5], 0.8, rtol=1e-6)


def test_a_base_that_never_turns_has_no_direction():
    assert not of_inputs(Variable.DIRECTION, inputs(angle=np.zeros(TIME.size)), 0.0).any()


def test_sliding_is_forgotten_in_some_seconds_whichever_way_it_was():
    """At 3 mm/s from a second after the start: 3 (1 - exp(-t / tau)), and as much where it is pulled."""
    speed = np.where(TIME < 1.0, 0.0, 3.0)
    there, back = (
        of_inputs(Variable.SLID_LATELY, replace(inputs(), speed_mm_s=way * speed), 0.0)
        for way in (1, -1)
    )
    np.testing.assert_array_equal(back, there)
    expected = 3.0 * (1 - np.exp(-np.maximum(TIME - 1.0, 0.0) / SLID_S))
    np.testing.assert_allclose(there, expected, atol=3.0 * STEP_S / SLID_S)  # speeds run straight


def test_a_rest_begins_when_the_needle_has_slid_and_lasts_as_long_as_any_before():
    """It slides from 1 to 2 s, and never again."""
    speed = np.where((TIME >= 1.0) & (TIME <= 2.0), -3.0, 0.0)
    rested = of_inputs(Variable.RESTED, replace(inputs(), speed_mm_s=speed), 0.0)
    assert (rested[TIME < 1.0] == RESTED_S).all()
    np.testing.assert_allclose(rested[TIME >= 1.0], np.maximum(TIME[TIME >= 1.0] - 2.0, 0.0), atol=1e-9)
    still = of_inputs(Variable.RESTED, replace(inputs(), speed_mm_s=0.0 * TIME), 0.0)
    np.testing.assert_array_equal(still, RESTED_S)


def test_the_axial_drag_is_the_inserted_length_with_the_sign_of_the_speed():
    for speed, sign in ((2.0, 1.0), (-2.0, -1.0), (0.0, 0.0)):
        moving = replace(inputs(), speed_mm_s=np.full(TIME.size, speed))
        drag = of_inputs(Variable.AXIAL_DRAG, moving, 0.0)
        np.testing.assert_allclose(drag, sign * moving.inserted_mm)


def test_history_is_what_was_turned_to_and_fro():
    for when_s, turned_deg in ((0.5, 0), (1.5, 45), (3.0, 90), (4.5, 120), (7.0, 150)):
        assert at(Variable.HISTORY, when_s) == pytest.approx(turned_deg / 360, abs=0.5 / 360)


def test_what_the_needle_does_is_known_of_its_readings():
    tip, torque = 0.5 * ANGLE, 0.01 * ANGLE
    given = (TIME, tip, torque)
    assert of_needle(Variable.TIP_ANGLE, *given) is tip
    assert of_needle(Variable.TORQUE, *given) is torque
    tip_rate, torque_rate = (of_needle(v, *given) for v in (Variable.TIP_RATE, Variable.TORQUE_RATE))
    for when_s, deg_s in RATES_DEG_S.items():
        assert np.interp(when_s, TIME, tip_rate) == pytest.approx(np.radians(0.5 * deg_s), abs=1e-9)
        assert np.interp(when_s, TIME, torque_rate) == pytest.approx(0.01 * deg_s, abs=1e-9)


def test_a_thrust_bearing_is_loaded_where_the_needle_is_pushed_and_turns():
    """By the inserted length, with the sign in which the drive slides; not where it is pulled."""
    time = np.arange(0.0, 6.0, 0.01)
    drive = np.interp(time, [0.0, 1.5, 3.0, 4.5, 6.0], [0.0, 30.0, 0.0, 30.0, 0.0])
    inputs = Schedule(
        time_s=time,
        drive=drive,
        free_mm=np.full(time.size, 60.0),
        inserted_mm=np.full(time.size, 80.0),
        speed_mm_s=np.where(time < 3.0, 2.0, -2.0),
    )
    thrust = of_inputs(Variable.THRUST, inputs, 0.0)
    at = np.searchsorted(time, [1.0, 2.5, 4.0, 5.5])
    np.testing.assert_allclose(thrust[at], [80.0, -80.0, 0.0, 0.0], atol=0.01)


def test_how_far_the_needle_has_slid_counts_from_the_start_of_the_trial():
    """Into the tissue at 2 mm/s up to 3 s, back at 1 mm/s from there on; the trial begins after 1 s."""
    moving = replace(inputs(), speed_mm_s=np.where(TIME < 3.0, 2.0, -1.0))
    slid, travelled = (of_inputs(v, moving, 1.0) for v in (Variable.SLID, Variable.TRAVELLED))
    at = np.searchsorted(TIME, [1.0, 2.0, 3.0, 5.0])
    np.testing.assert_allclose(slid[at], [0.0, 2.0, 4.0, 2.0], atol=2.0 * STEP_S)
    np.testing.assert_allclose(travelled[at], [0.0, 2.0, 4.0, 6.0], atol=2.0 * STEP_S)
