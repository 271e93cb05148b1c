"""The inputs of needles in SI units, and where a run begins."""

import math
from dataclasses import replace

import numpy as np
import pytest

from models.drive import Drive, DriveKind
from models.errors import InvalidValue
from models.needle import NITINOL
from models.tissue import Tissue
from sim.discretisation import Arrangement, Discretisation
from sim.kernel import memory_map
from sim.needles.inputs import at_steps, controls, controls_of_each, initial_data
from sim.needles.kept import compile_model
from sim.needles.setup import Setup
from sim.schedule import Schedule

STEP_S = 0.01
TIME = np.array([0.0, 0.3, 3.0])
TURN = Schedule(
    time_s=TIME,
    drive=np.array([30.0, 90.0, 90.0]),
    free_mm=np.array([50.0, 45.0, 40.0]),
    inserted_mm=np.full(3, 100.0),
    speed_mm_s=np.full(3, 2.0),
    tip_torque_n_mm=np.array([0.0, 0.5, 0.5]),
    tissue_factor=np.array([1.0, 1.0, 1.5]),
)
LONGER = replace(TURN, time_s=np.array([0.0, 0.3, 4.0]))


def setup(kind=DriveKind.ANGLE, arrangement=Arrangement.CHAIN, free=50.0):
    return Setup(
        needle=NITINOL,
        tissue=Tissue.uniform(viscous_n_mm_s_per_mm=0.01725),
        drive=Drive(kind=kind),
        discretisation=Discretisation(elements=4, arrangement=arrangement),
        free_mm=free,
        inserted_mm=100.0,
    )


@pytest.mark.parametrize(
    ("kind", "first"), [(DriveKind.ANGLE, math.radians(30.0)), (DriveKind.TORQUE, 0.03)]
)
def test_every_input_is_in_si_units(kind, first):
    ctrl = controls(TURN, setup(kind))
    assert ctrl[0, memory_map.U_DRIVE] == pytest.approx(first)
    assert ctrl[2, memory_map.U_CARRIAGE] == pytest.approx(0.010)  # m, by which the chuck has moved
    assert ctrl[2, memory_map.U_INSERTED] == pytest.approx(0.100)
    assert ctrl[2, memory_map.U_SPEED] == pytest.approx(0.002)
    assert ctrl[1, memory_map.U_TIP] == pytest.approx(0.5e-3)
    np.testing.assert_allclose(ctrl[:, memory_map.U_TISSUE], [0.0, 0.0, 0.5])


def test_set_ups_share_inputs_where_these_are_the_same():
    first, same, freer = controls_of_each([TURN] * 3, [setup(), setup(), setup(free=60.0)])
    assert first is same
    assert freer[0, memory_map.U_CARRIAGE] == pytest.approx(0.010)


def test_inputs_are_as_many_as_set_ups_and_last_as_long():
    with pytest.raises(InvalidValue, match="one for each of 2"):
        at_steps([TURN], 2, STEP_S)
    with pytest.raises(InvalidValue, match="the same number of steps"):
        at_steps([TURN, LONGER], 2, STEP_S)
    one, other = at_steps(TURN, 2, STEP_S)
    assert one.time_s.size == other.time_s.size == 301


@pytest.mark.parametrize(
    ("arrangement", "joints"), [(Arrangement.CHAIN, [1, 0, 0, 0, 0, 0]), (Arrangement.SIBLINGS, [1] * 6)]
)
def test_a_run_begins_untwisted_at_the_angle_of_the_drive(arrangement, joints):
    """Free length and four elements: joints of a chain are relative, those of siblings absolute."""
    made = setup(arrangement=arrangement)
    data = initial_data(compile_model(made), made, controls(TURN, made)[0])
    np.testing.assert_allclose(data.qpos[1:], math.radians(30.0) * np.array(joints))
    assert not data.qvel.any()
