"""The parts of what the callback adds, and their sum."""

import mujoco
import numpy as np
import pytest

from models.needle import NITINOL
from models.tissue import Tissue
from sim.discretisation import Arrangement, Discretisation
from sim.kernel import memory_map
from sim.needles.kept import compile_model
from sim.needles.passive_torques import passive_torques
from sim.needles.setup import Setup


def setup(**discretisation):
    return Setup(
        needle=NITINOL,
        tissue=Tissue.uniform(viscous_n_mm_s_per_mm=0.01725),
        discretisation=Discretisation(elements=8, **discretisation),
        free_mm=50,
        inserted_mm=150,
    )


def test_what_is_added_to_qfrc_passive_is_the_sum_of_the_parts():
    """`qfrc_passive` also holds MuJoCo's own joint springs, at the start of the step."""
    for order in (1, 2, 3):
        model = compile_model(setup(order=order))
        data = mujoco.MjData(model)
        data.ctrl[memory_map.U_INSERTED] = 0.15
        data.ctrl[memory_map.U_DRIVE] = 0.5
        mujoco.mj_step(model, data, 3)
        start = data.qpos.copy()
        mujoco.mj_forward(model, data)
        torques = passive_torques(model, data)
        added = (data.qfrc_passive + model.jnt_stiffness * start)[1:]
        parts = torques.tissue + torques.other + torques.correction
        assert added == pytest.approx(parts, abs=1e-10)
        assert np.abs(parts).max() > 1e-5


def test_siblings_get_the_springs_that_their_model_lists():
    made = setup(arrangement=Arrangement.SIBLINGS)
    model = compile_model(made)
    data = mujoco.MjData(model)
    data.ctrl[memory_map.U_INSERTED] = 0.15
    data.ctrl[memory_map.U_DRIVE] = 0.5
    mujoco.mj_step(model, data, 3)
    mujoco.mj_forward(model, data)
    torques = passive_torques(model, data)
    assert abs(torques.other.sum()) < 1e-9  # inner torques
    assert np.abs(torques.other).max() > 1e-6
