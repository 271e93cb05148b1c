"""The callback's own steps are those on which MuJoCo's land."""

import numpy as np
import pytest

from models.drive import Drive, DriveKind
from models.needle import NITINOL
from models.tissue import Tissue
from sim.discretisation import Arrangement, Discretisation
from sim.kernel import memory_map
from sim.needles.callback_loop import run_callback
from sim.needles.kept import models_of
from sim.needles.setup import Setup
from sim.schedule import Schedule
from sim.simulation import simulate

TIME = np.linspace(0.0, 4.0, 401)
INPUTS = Schedule(
    time_s=TIME,
    drive=20.0 + 40.0 * np.sin(2 * np.pi * 0.5 * TIME),
    free_mm=50.0 - TIME,
    inserted_mm=np.full(TIME.size, 100.0),
    speed_mm_s=np.ones(TIME.size),
)
BETA = 0.01725
TISSUES = {
    "viscous": {},
    "dry": {"kinetic_n_mm_per_mm": 0.001},
    "stiction": {"kinetic_n_mm_per_mm": 0.001, "static_n_mm_per_mm": 0.002, "stribeck_rad_s": 0.1},
    "elastic": {"stiffness_n_mm_per_rad_per_mm": 0.02, "time_constant_s": 1.0},
}
# MuJoCo's own tolerance on where its step ends, rad, is refused beyond 1e-8.
ANGLE = 1e-9


def both(setup):
    return (simulate([setup], INPUTS, callback_alone=alone)[0] for alone in (False, True))


@pytest.mark.parametrize("arrangement", Arrangement)
@pytest.mark.parametrize("tissue", TISSUES)
def test_tip_and_torque_are_mujocos(tissue, arrangement):
    setup = Setup(
        needle=NITINOL,
        tissue=Tissue.uniform(viscous_n_mm_s_per_mm=BETA, **TISSUES[tissue]),
        drive=Drive(backlash_deg=1.0),
        discretisation=Discretisation(elements=5, arrangement=arrangement),
        free_mm=50.0,
        inserted_mm=100.0,
    )
    mujoco, alone = both(setup)
    assert np.abs(mujoco.tip_deg - alone.tip_deg).max() < np.degrees(ANGLE)
    scale = np.abs(mujoco.base_torque_n_mm).max()
    # The servo is a million times stiffer than the shaft: rounding of its angle is that much torque.
    assert np.abs(mujoco.base_torque_n_mm - alone.base_torque_n_mm).max() < 1e-6 * scale
    assert alone.outputs[-1, memory_map.O_LANDING] < 1e-14  # sums of hinges round


def test_a_drive_that_gives_torque_is_mujocos_too():
    setup = Setup(
        needle=NITINOL,
        tissue=Tissue.uniform(viscous_n_mm_s_per_mm=BETA),
        drive=Drive(kind=DriveKind.TORQUE, rotor_inertia_kg_m2=1e-7),
        free_mm=50.0,
        inserted_mm=100.0,
    )
    mujoco, alone = both(setup)
    assert np.abs(mujoco.tip_deg - alone.tip_deg).max() < 1e-9 * np.abs(mujoco.tip_deg).max()


def test_a_needle_at_rest_stays_there_whatever_ran_before():
    setup = Setup(
        needle=NITINOL,
        tissue=Tissue.uniform(viscous_n_mm_s_per_mm=BETA, kinetic_n_mm_per_mm=0.001),
        discretisation=Discretisation(elements=5, arrangement=Arrangement.SIBLINGS),
        free_mm=50.0,
        inserted_mm=100.0,
    )
    simulate([setup], INPUTS, callback_alone=True)
    ctrl = np.zeros((1, 20, memory_map.INPUTS))
    ctrl[..., memory_map.U_DRIVE], ctrl[..., memory_map.U_INSERTED] = 0.5, 0.1
    with models_of([setup]) as models:
        joints = np.full(models[0].nq, 0.5)
        joints[0] = 0.0
        outputs = np.full((1, 19, memory_map.OUTPUTS), np.nan)
        run_callback(models, [joints], list(ctrl), list(outputs))
    np.testing.assert_allclose(outputs[0, :, memory_map.O_TIP_ANGLE], 0.5, rtol=1e-12)
    np.testing.assert_allclose(outputs[0, :, memory_map.O_FRICTION], 0.0, atol=1e-12)


def test_needles_of_several_sizes_run_as_each_does_alone():
    coarse, fine, soft = (
        Setup(
            needle=NITINOL,
            tissue=Tissue.uniform(viscous_n_mm_s_per_mm=BETA, kinetic_n_mm_per_mm=level),
            discretisation=Discretisation(elements=elements, arrangement=Arrangement.SIBLINGS),
            free_mm=50.0,
            inserted_mm=inserted,
        )
        for elements, level, inserted in ((5, 0.001, 100.0), (8, 0.001, 100.0), (5, 0.0, 90.0))
    )
    setups = [coarse, fine, soft, coarse]
    together = simulate(setups, INPUTS, callback_alone=True)
    for setup, run in zip(setups, together, strict=True):
        alone = simulate([setup], INPUTS, callback_alone=True)[0]
        np.testing.assert_array_equal(run.outputs, alone.outputs)
    assert not np.array_equal(together[0].outputs, together[2].outputs)
