"""The steered insertion of Figs. 11 and 12."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from diagnosis.replay.rig_parameters import RigParameters
from sim.closed_loop import Measurement
from studies.published.experiments import insertion
from studies.published.experiments.base_turn import BaseTurn, BaseTurnShape
from studies.published.experiments.insertion import (
    InsertionRig,
    ServoedController,
    WindingSense,
    base_alone,
    deviation_compensated_mm,
    deviation_mm,
    deviations_alone_mm,
    reference,
)

SERVO = BaseTurn(shape=BaseTurnShape.SERVO, time_s=0.11)


def test_the_half_turns_go_to_and_fro_or_all_one_way():
    assert list(WindingSense.TO_AND_FRO.angles_deg) == [0, 180, 0, 180, 0]
    assert list(WindingSense.ONE_WAY.angles_deg) == [0, 180, 360, 540, 720]


def test_the_reference_steps_after_each_of_the_first_four_centimetres():
    asked = reference(120.0, WindingSense.TO_AND_FRO)
    assert (asked.inserted_mm[-1], asked.time_s[-1]) == (70.0, 14.0)
    jumps = np.flatnonzero(np.diff(asked.drive))
    assert asked.inserted_mm[jumps] == pytest.approx([10, 20, 30, 40])
    assert np.diff(asked.drive)[jumps] == pytest.approx([180, -180, 180, -180])
    assert asked.free_mm + asked.inserted_mm == pytest.approx(120.0)


@pytest.mark.parametrize(("turn", "after_s"), [(BaseTurn(), 0.6), (SERVO, 1.0)])
def test_the_base_alone_ends_each_half_turn_where_it_should(turn, after_s):
    inputs = base_alone(InsertionRig(turn=turn))
    at = np.array([2.0, 2.0 + after_s, 4.0, 4.0 + after_s])
    # A servo is within (1 + 9) exp(-9) = 0.12 % of a half turn after nine time constants.
    assert np.interp(at, inputs.time_s, inputs.drive) == pytest.approx([0, 180, 180, 0], abs=0.25)
    assert np.interp(2.0 + 0.5 * after_s, inputs.time_s, inputs.drive) > 89.0


def test_without_friction_the_path_is_that_of_a_rigid_needle():
    """dp/ds = t, dt/ds = (cos theta n + sin theta b) / R, integrated with the base's angle."""
    inputs = base_alone(InsertionRig())

    def frame(s, state):
        t, n, b = state[3:6], state[6:9], state[9:12]
        roll = np.radians(np.interp(s, inputs.inserted_mm, inputs.drive))
        pull = (np.cos(roll) * n + np.sin(roll) * b) / 61.0
        # n and b are carried along without turning about t.
        return np.concatenate([t, pull, -np.cos(roll) * t / 61.0, -np.sin(roll) * t / 61.0])

    start = np.concatenate([np.zeros(3), np.eye(3).ravel()])
    path = solve_ivp(frame, (0, 70), start, rtol=1e-7, atol=1e-9, max_step=0.25).y
    rigid = InsertionRig(model=RigParameters(damping_scale=1e-6))
    # Steps of 0.05 mm: the frame turns by 1e-3 in each, the error of a half step.
    assert deviations_alone_mm([rigid])[0] == pytest.approx(np.abs(path[2]).max(), abs=0.02)


def test_the_stated_rig_deviates_less_with_compensation_and_less_if_wound_one_way():
    rig, one_way = InsertionRig(), WindingSense.ONE_WAY
    alone, compensated = deviations_alone_mm([rig])[0], deviation_compensated_mm(rig)
    assert (alone, compensated) == pytest.approx((6.5, 1.95), abs=0.05)
    assert deviations_alone_mm([rig], one_way)[0] == pytest.approx(0.69, abs=0.01)
    assert deviation_compensated_mm(rig, one_way) == pytest.approx(0.17, abs=0.01)


def test_steps_and_elements_are_fine_enough(monkeypatch):
    rig = InsertionRig(model=RigParameters(kinetic_n_mm_per_mm=0.03))
    coarse = deviations_alone_mm([rig])[0], deviation_compensated_mm(rig)
    monkeypatch.setattr(insertion, "INSERTION_STEP_S", 0.5 * insertion.INSERTION_STEP_S)
    monkeypatch.setattr(insertion, "INSERTION_ELEMENTS", 2 * insertion.INSERTION_ELEMENTS)
    fine = deviations_alone_mm([rig])[0], deviation_compensated_mm(rig)
    # "within 0.1 mm" of studies/published/criteria.py
    assert coarse == pytest.approx(fine, abs=0.1)


def test_rigs_of_different_motions_come_back_in_their_order():
    rigs = [InsertionRig(), InsertionRig(shaft_mm=200.0), InsertionRig(), InsertionRig(turn=SERVO)]
    together = deviations_alone_mm(rigs)
    assert together == pytest.approx([deviations_alone_mm([rig])[0] for rig in rigs])
    assert together[0] == together[2] != together[1]


def test_a_servo_turns_a_held_command_into_its_own_step_response():
    class Held:
        advance_mm = -1.0

        def __call__(self, measurement, reference_deg):
            return reference_deg

    servo = ServoedController(Held(), SERVO.time_s)
    at = Measurement(time_s=0, base_deg=0, torque_n_mm=0, tip_deg=0, inserted_mm=0, free_mm=0)
    base = [servo(at, 90.0) for _ in range(100)]
    time = insertion.INSERTION_STEP_S * np.arange(1, 101)
    assert base == pytest.approx(SERVO.angle_deg(time), abs=1e-9)
    assert servo.advance_mm == -1.0


def test_a_servo_without_delay_is_the_motor_alone():
    immediate = BaseTurn(shape=BaseTurnShape.SERVO, time_s=1e-5)
    bare, servoed = (deviation_compensated_mm(InsertionRig(turn=t)) for t in (BaseTurn(), immediate))
    assert servoed == pytest.approx(bare, abs=1e-6)
    # A real one lags; the compensator then overshoots, which takes height back.
    assert abs(deviation_compensated_mm(InsertionRig(turn=SERVO)) - bare) > 0.3


def test_deviation_is_on_either_side_of_the_plane():
    class Straight:
        tip_deg = np.full(100, -90.0)

        class inputs:  # noqa: N801
            inserted_mm = np.linspace(0, 10, 100)

    # A tip that points sideways all the way: an arc of radius 61 mm.
    assert deviation_mm(Straight()) == pytest.approx(61 * (1 - np.cos(10 / 61)), rel=1e-6)
