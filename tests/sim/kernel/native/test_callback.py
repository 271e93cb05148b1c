"""The installed callbacks leave other models alone, and show their work on ours."""

import mujoco
import numpy as np
import pytest

from models.needle import NITINOL
from models.tissue import Tissue
from sim.kernel import memory_map
from sim.kernel.native.callback import install
from sim.needles.setup import Setup
from sim.spec import needle_spec


def test_other_models_pass_the_callback_untouched():
    install()
    xml = """<mujoco><custom><numeric name="gains" data="1 2 3"/></custom><worldbody>
      <body><joint type="hinge" stiffness="3"/><geom size=".1" pos=".2 0 0"/></body>
      </worldbody></mujoco>"""
    model = mujoco.MjModel.from_xml_string(xml)
    data = mujoco.MjData(model)
    data.qpos[0] = 0.1
    mujoco.mj_forward(model, data)
    assert data.qfrc_passive == pytest.approx([-0.3])


def needle_model():
    tissue = Tissue.uniform(viscous_n_mm_s_per_mm=0.02)
    return needle_spec(Setup(needle=NITINOL, tissue=tissue, free_mm=0, inserted_mm=50)).compile()


def after_a_step(model):
    install()
    data = mujoco.MjData(model)
    data.ctrl[memory_map.U_INSERTED] = 0.05
    data.ctrl[memory_map.U_DRIVE] = 1.0
    mujoco.mj_step(model, data)
    return data


def test_without_its_mark_a_needle_feels_no_tissue():
    """Negative control: the header alone makes a model ours."""
    ours, theirs = needle_model(), needle_model()
    theirs.numeric("needle").data[memory_map.H_MAGIC] = 0.0
    assert np.abs(after_a_step(ours).sensordata).max() > 0
    assert np.abs(after_a_step(theirs).sensordata).max() == 0


def test_the_sensors_show_the_outputs_of_the_step():
    data = after_a_step(needle_model())
    # The step starts with the callback at its end: mj_step shows the state that it left.
    assert data.sensordata.size == memory_map.OUTPUTS == len(memory_map.OUTPUT_SENSORS)
    assert data.sensor("base_torque").data[0] == data.sensordata[memory_map.O_BASE_TORQUE] > 0


def test_installing_again_returns_the_same_callbacks():
    assert install() is install()
    assert mujoco.get_mjcb_passive() is not None
