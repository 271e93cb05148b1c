"""One step of needle and tissue: the compiled step beside its source."""

import mujoco
import numpy as np
import pytest

from models import units
from models.needle import NITINOL
from models.tissue import Tissue
from sim.discretisation import Discretisation
from sim.law_table import law_table
from sim.needles.inputs import controls, initial_data
from sim.needles.kept import compile_model
from sim.needles.numeric_fields import header
from sim.needles.setup import Setup
from sim.schedule import Schedule

TISSUE = Tissue.uniform(
    viscous_n_mm_s_per_mm=0.01,
    kinetic_n_mm_per_mm=0.001,
    shared_n_mm_per_mm=0.001,
    stiffness_n_mm_per_rad_per_mm=0.02,
    time_constant_s=0.5,
).but(entry_friction_n_mm=0.05)


@pytest.fixture(scope="module")
def run():
    """A turn while the needle slides, by MuJoCo and the compiled callback."""
    cut = Discretisation(elements=6, step_s=0.01)
    setup = Setup(needle=NITINOL, tissue=TISSUE, discretisation=cut, free_mm=30, inserted_mm=60)
    time = np.array([0.0, 0.1, 0.2])
    inputs = Schedule(
        time_s=time,
        drive=np.array([0.0, 30.0, 10.0]),
        free_mm=30 + 2.0 * time,
        inserted_mm=np.full(3, 60.0),
        speed_mm_s=np.full(3, -2.0),
        tip_torque_n_mm=np.array([0.0, 0.05, 0.05]),
    )
    model = compile_model(setup)
    ctrl = controls(inputs.at_steps(0.01), setup)
    data, states = initial_data(model, setup, ctrl[0]), []
    for u in ctrl[1:]:
        data.ctrl[:] = u
        mujoco.mj_step(model, data)
        states.append(np.concatenate([np.cumsum(data.qpos[1:]), data.sensordata]))
    return setup, ctrl, np.array(states)


def by_the_interpreter(interpreted, shaft, setup, ctrl):
    """The same steps by `sim.kernel.step` in the interpreter, without MuJoCo."""
    places = interpreted.memory_map
    law = law_table(setup.needle, setup.drive, setup.tissue, rows=setup.rows)
    head, mesh = header(setup, rows=len(law)), setup.nodes_mm * units.MM
    n, size = mesh.size - 1, places.block(mesh.size - 1, len(law))
    now, nxt = np.zeros(size), np.zeros(size)
    now[places.B_INPUTS : places.B_INPUTS + places.INPUTS] = ctrl[0]
    scratch, torques = np.zeros(places.scratch(n, len(law))), np.zeros((places.TORQUES, n + 1))
    angles = slice(places.B_ANGLES, places.B_ANGLES + n + 1)
    rates = slice(places.B_ANGLES + n + 1, places.B_ANGLES + 2 * (n + 1))
    states = []
    for u in ctrl[1:]:
        start = (now[angles].copy(), now[rates].copy())
        interpreted.step.advance(
            head, mesh, law, shaft, 0.0, 0.01, *start, now, nxt, u, torques, scratch
        )
        states.append(np.concatenate([nxt[angles], nxt[: places.OUTPUTS]]))
        now[:] = nxt
    return np.array(states)


def test_the_compiled_step_in_mujoco_lands_where_its_source_says(interpreted, shaft_of, run):
    setup, ctrl, compiled = run
    source = by_the_interpreter(interpreted, shaft_of(setup), setup, ctrl)
    n = setup.nodes_mm.size
    # Newton's method stops within 1e-10 rad/s: 1e-12 rad a step, 2e-11 over 20.
    assert np.abs(source[:, :n] - compiled[:, :n]).max() < 2e-11
    torque = n + interpreted.memory_map.O_BASE_TORQUE
    assert source[:, torque] == pytest.approx(compiled[:, torque], rel=1e-5)
    assert np.ptp(source[:, torque]) > 1e-5  # N m: something happened


def test_a_stage_that_differs_by_a_thousandth_would_be_seen(interpreted, shaft_of, run, monkeypatch):
    """Negative control."""
    setup, ctrl, compiled = run
    changed = tuple(1.001 * gamma for gamma in interpreted.step.GAMMAS)
    monkeypatch.setattr(interpreted.step, "GAMMAS", changed)
    source = by_the_interpreter(interpreted, shaft_of(setup), setup, ctrl)
    n = setup.nodes_mm.size
    assert np.abs(source[:, :n] - compiled[:, :n]).max() > 1e-7
