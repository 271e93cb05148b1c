"""The simulated needle against closed forms; batches, states and convergence order."""

import math
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context

import mujoco
import numpy as np
import pytest

from models.drive import Drive, DriveKind
from models.errors import InvalidValue
from models.modes import InsertedNeedle
from models.needle import NITINOL
from models.statespace import modal_system
from models.tissue import Tissue
from sim.discretisation import Arrangement, Discretisation, Mesh
from sim.kernel import memory_map
from sim.needles.inputs import controls, initial_data
from sim.needles.kept import compile_model
from sim.needles.setup import Setup
from sim.schedule import Schedule
from sim.simulation import prepare_processes, simulate
from studies.crosscheck import motion

BETA = 0.01725


def schedule(time, drive, *, inserted=100.0, free=50.0, speed=0.0):
    time = np.asarray(time, float)
    still = np.ones_like(time)
    return Schedule(
        time_s=time,
        drive=np.asarray(drive, float),
        free_mm=free - speed * time,
        inserted_mm=inserted * still,
        speed_mm_s=speed * still,
    )


def setup(tissue=None, *, free=50.0, inserted=100.0, drive=None, mesh=Mesh.EULERIAN, rows=0, **cut):
    return Setup(
        needle=NITINOL,
        tissue=tissue or Tissue.uniform(viscous_n_mm_s_per_mm=BETA),
        drive=drive or Drive(),
        discretisation=Discretisation(**cut),
        mesh=mesh,
        free_mm=free,
        inserted_mm=inserted,
        rows=rows,
    )


TURN = schedule([0, 0.3, 3], [0, 90, 90])
DRY = Tissue.uniform(viscous_n_mm_s_per_mm=BETA, kinetic_n_mm_per_mm=0.0015)
SOFT = Tissue.uniform(
    viscous_n_mm_s_per_mm=BETA, stiffness_n_mm_per_rad_per_mm=0.02, time_constant_s=1.0
)


@pytest.mark.parametrize("free", [0.0, 50.0])
def test_the_fast_turn_stays_within_the_stated_tip_error(free):
    error = motion.tip_error_deg(motion.viscous_setup(free_mm=free), motion.fast_turn(free_mm=free))
    assert error < 0.002  # "within 0.002 deg", sim.discretisation


def test_base_torque_agrees_with_the_closed_form():
    run = simulate([setup()], TURN)[0]
    needle = InsertedNeedle(needle=NITINOL, damping_n_mm_s_per_mm=BETA, inserted_mm=100, free_mm=50)
    exact = needle.respond(run.time_s, np.radians(run.inputs.drive), count=400)
    peak = exact.base_torque_n_mm.max()
    assert np.abs(run.base_torque_n_mm - exact.base_torque_n_mm).max() < 1e-3 * peak


def test_a_torque_driven_needle_turns_as_the_modal_state_space_says():
    time = np.linspace(0, 2, 2001)
    torque = 0.5 * np.sin(2 * np.pi * 0.5 * time) ** 2
    drive = Drive(kind=DriveKind.TORQUE)
    run = simulate([setup(drive=drive, step_s=0.002, elements=32)], schedule(time, torque))[0]
    held = InsertedNeedle(needle=NITINOL, damping_n_mm_s_per_mm=BETA, inserted_mm=100, free_mm=50)
    import control

    expected = control.forced_response(modal_system(held, modes=60), time, torque).outputs
    tip = np.interp(time, run.time_s, run.tip_deg)
    assert np.abs(tip - np.degrees(expected[1])).max() < 1e-3 * np.degrees(expected[1]).max()


def test_the_methods_are_of_second_and_of_first_order_in_the_step():
    second, first = motion.order_in_step()
    assert second.passed, second
    assert first.passed, first


@pytest.mark.parametrize("tissue", [DRY, SOFT], ids=["dry", "soft"])
def test_halving_the_step_converges_in_nonlinear_tissue_too(tissue):
    time = np.linspace(0, 4, 4001)
    smooth = 45 * (1 - np.cos(np.pi * time))  # there and back, twice
    runs = [simulate([setup(tissue, step_s=h)], schedule(time, smooth))[0] for h in (0.04, 0.02, 0.01)]
    coarse = np.abs(runs[0].tip_deg - runs[1].tip_deg[::2]).max()
    fine = np.abs(runs[1].tip_deg - runs[2].tip_deg[::2]).max()
    # Second order between events; a stick-slip event inside a step costs up to one order.
    assert math.log2(coarse / fine) > 1.2


@pytest.mark.parametrize(("tissue", "times"), [(None, 4), (SOFT, 3), (DRY, 2)])
def test_a_step_of_third_order_errs_less(tissue, times):
    """At 20 ms; where dry friction slips and sticks, a corner inside a step costs part of the order."""
    exact = simulate([setup(tissue, step_s=0.0025, order=3)], TURN)[0].tip_deg[::8]
    second, third = (
        np.abs(simulate([setup(tissue, step_s=0.02, order=order)], TURN)[0].tip_deg - exact).max()
        for order in (2, 3)
    )
    assert times * third < second


@pytest.mark.parametrize("tissue", [None, DRY, SOFT], ids=["viscous", "dry", "soft"])
def test_siblings_land_where_the_chain_lands(tissue):
    chain, siblings = (simulate([setup(tissue, arrangement=a)], TURN)[0] for a in Arrangement)
    assert np.abs(chain.tip_deg - siblings.tip_deg).max() < 1e-8
    assert np.abs(chain.base_torque_n_mm - siblings.base_torque_n_mm).max() < 1e-8


def test_mujoco_lands_where_the_callback_wants_it():
    run = simulate([setup(DRY)], TURN)[0]
    assert run.outputs[-1, memory_map.O_LANDING] < 1e-12
    assert run.unconverged == 0


def test_different_tissues_run_side_by_side_as_they_do_alone():
    setups = [setup(t, rows=1) for t in (None, DRY, SOFT)]
    together = simulate(setups, TURN, threads=2)
    for one, beside in zip(setups, together, strict=True):
        assert np.array_equal(simulate([one], TURN)[0].outputs, beside.outputs)


def test_set_ups_may_each_have_inputs_of_their_own():
    slower = schedule([0, 1.3, 3], [0, 45, 45], inserted=80.0)
    setups, inputs = [setup(), setup(inserted=80.0), setup()], [TURN, slower, TURN]
    for one, own, beside in zip(setups, inputs, simulate(setups, inputs), strict=True):
        assert np.array_equal(simulate([one], own)[0].outputs, beside.outputs)


def test_a_saved_state_restores_exactly():
    tissue = Tissue.uniform(
        viscous_n_mm_s_per_mm=BETA,
        kinetic_n_mm_per_mm=0.001,
        stiffness_n_mm_per_rad_per_mm=0.02,
        time_constant_s=1.0,
    )
    rig = setup(tissue)
    model, inputs = compile_model(rig), TURN.at_steps(0.01)
    ctrl = controls(inputs, rig)
    data = initial_data(model, rig, ctrl[0])
    full = mujoco.mjtState.mjSTATE_INTEGRATION
    state = np.empty(mujoco.mj_stateSize(model, full))
    for u in ctrl[1:40]:
        data.ctrl[:] = u
        mujoco.mj_step(model, data)
    mujoco.mj_getState(model, data, state, full)

    def onward(d):
        for u in ctrl[40:80]:
            d.ctrl[:] = u
            mujoco.mj_step(model, d)
        return d.qpos.copy()

    first = onward(data)
    other = mujoco.MjData(model)
    mujoco.mj_setState(model, other, state, full)
    assert np.array_equal(onward(other), first)


def test_calling_forward_again_changes_nothing():
    rig = setup(DRY)
    model, ctrl = compile_model(rig), controls(TURN.at_steps(0.01), rig)

    def run(forwards):
        data = initial_data(model, rig, ctrl[0])
        for u in ctrl[1:60]:
            data.ctrl[:] = u
            for _ in range(forwards):
                mujoco.mj_forward(model, data)
            mujoco.mj_step(model, data)
        return data.qpos.copy()

    assert np.array_equal(run(0), run(3))


def test_setups_of_different_size_are_refused_together():
    with pytest.raises(InvalidValue, match="same number of elements"):
        simulate([setup(), setup(elements=8)], TURN)


def test_a_needle_that_goes_in_starts_free_and_ends_held():
    time = np.array([0.0, 1.0, 9.0, 10.0])
    depth = np.array([0.0, 0.0, 80.0, 80.0])
    advance = Schedule(
        time_s=time,
        drive=np.array([0.0, 90.0, 90.0, 180.0]),
        free_mm=100 - depth,
        inserted_mm=depth,
        speed_mm_s=np.array([0.0, 10.0, 10.0, 0.0]),
    )
    run = simulate([setup(free=100, inserted=0, mesh=advance.mesh, elements=32)], advance)[0]
    outside = run.time_s <= 1.0
    assert np.abs(run.tip_deg - run.inputs.drive)[outside].max() < 1e-3  # nothing holds it
    assert run.inputs.drive[-1] - run.tip_deg[-1] > 10  # 8 cm of tissue does


def test_a_needle_at_a_depth_behaves_alike_on_either_mesh():
    """Nodes fixed to the needle or to the tissue: the same needle, deep and at rest."""
    moves = schedule([0, 0.3, 3], [0, 90, 90], inserted=100, free=60)
    fixed = simulate([setup(free=60, inserted=100, elements=64)], moves)[0]
    along = simulate([setup(free=60, inserted=100, elements=64, mesh=Mesh.LAGRANGIAN)], moves)[0]
    assert np.abs(fixed.tip_deg - along.tip_deg).max() < 5e-3


@pytest.mark.parametrize("slip", ["material", "place"])
def test_both_meshes_agree_on_a_needle_that_slides_through(slip):
    """A long needle drawn through a slab: in one mesh nodes move, in the other tissue does."""
    time = np.array([0.0, 1.0, 1.3, 5.0])
    speed, free, inserted, beyond = -5.0, 50.0, 100.0, 25.0
    inputs = Schedule(
        time_s=time,
        drive=np.array([0.0, 0.0, 90.0, 90.0]),
        free_mm=free - speed * time,
        inserted_mm=np.full(4, inserted),
        speed_mm_s=np.full(4, speed),
    )
    tissue = simulate([setup(free=free, inserted=inserted, elements=48, slip=slip)], inputs)[0]
    along = setup(free=free, inserted=inserted + beyond, elements=96, slip=slip, mesh=Mesh.LAGRANGIAN)
    needle = simulate([along], inputs)[0]
    # The needle's mesh meets the edges of the tissue inside its elements: (180/96)^2 / 12 ~ 0.3
    # of a node's load moves by a fraction of 1.9 mm; of 90 deg over 150 mm that is 0.03 deg.
    assert np.abs(tissue.tip_deg - needle.tip_deg).max() < 0.03


def test_the_two_slip_rates_differ_when_a_twisted_needle_slides():
    moves = schedule([0, 0.3, 5], [0, 90, 90], speed=-5.0)
    material, place = (simulate([setup(slip=s)], moves)[0].tip_deg for s in ("material", "place"))
    assert 0.01 < np.abs(material - place).max() < 2.0


def _callback_is_installed():
    return mujoco.get_mjcb_passive() is not None


def test_a_process_inherits_the_callback_that_was_prepared_before_it_was_forked():
    prepare_processes()
    with ProcessPoolExecutor(1, mp_context=get_context("fork")) as pool:
        assert pool.submit(_callback_is_installed).result()
