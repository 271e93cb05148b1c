"""The parts of what the callback adds: tissue, what joints cannot hold, correction."""

import mujoco
import numpy as np
import pytest

from models.drive import Drive
from models.needle import NITINOL
from models.tissue import Tissue
from sim.discretisation import Discretisation
from sim.kernel.mesh import XI_LEFT, XI_RIGHT
from sim.needles.inputs import controls, initial_data
from sim.needles.kept import compile_model
from sim.needles.passive_torques import passive_torques
from sim.needles.setup import Setup
from sim.schedule import Schedule
from sim.simulation import simulate

BETA = 0.01725  # N m s / rad / m, which is N mm s / rad / mm
VISCOUS = Tissue.uniform(viscous_n_mm_s_per_mm=BETA)


def setup(tissue=VISCOUS, drive=None, **discretisation):
    return Setup(
        needle=NITINOL,
        tissue=tissue,
        drive=drive or Drive(),
        discretisation=Discretisation(elements=8, **discretisation),
        free_mm=50,
        inserted_mm=150,
    )


def steps(setup, *, count=20, slide_mm_s=0.0):
    """A turn at 90 deg/s, step by step: (angles before, angles after, torques, qfrc_passive)."""
    time = np.array([0.0, 1.0])
    inputs = Schedule(
        time_s=time,
        drive=np.array([0.0, 90.0]),
        free_mm=50.0 + slide_mm_s * time,
        inserted_mm=np.full(2, 150.0),
        speed_mm_s=np.full(2, -slide_mm_s),
    )
    model = compile_model(setup)
    ctrl = controls(inputs.at_steps(model.opt.timestep), setup)
    data = initial_data(model, setup, ctrl[0])
    rows = []
    for u in ctrl[1 : count + 1]:
        data.ctrl[:] = u
        before = np.cumsum(data.qpos[1:])
        mujoco.mj_step(model, data)
        springs = -model.jnt_stiffness * data.qpos
        rows.append((before, np.cumsum(data.qpos[1:]), passive_torques(model, data), springs))
    return model, data, rows


def viscous_joint_torques(nodes_m, rates):
    """The damping of the contact sites, assembled here from its statement: each element's two
    sites, at the fractions XI, load its nodes as they lie between them; where coverage ends at
    the free element's side, the left node's share is that of the exact integral."""
    n = rates.size - 1
    nodal = np.zeros(n + 1)
    for e in range(1, n):  # element 0 is free
        a = nodes_m[e + 1] - nodes_m[e]
        slip = np.array(
            [
                xi_r * rates[e] + xi_l * rates[e + 1]
                for xi_l, xi_r in ((XI_LEFT, XI_RIGHT), (XI_RIGHT, XI_LEFT))
            ]
        )
        if e == 1:  # sum a / 2, first moment a / 6, by the two sites
            right = a * (1 / 6 - XI_LEFT / 2) / (XI_RIGHT - XI_LEFT)
            to_left = np.array([a / 2 - right, right])
        else:
            to_left = a / 2 * np.array([XI_RIGHT, XI_LEFT])
        nodal[e] -= BETA * to_left @ slip
        nodal[e + 1] -= BETA * (a / 2 * np.array([XI_LEFT, XI_RIGHT])) @ slip
    return np.cumsum(nodal[::-1])[::-1]


def test_a_first_order_step_adds_the_torque_of_the_tissue_and_nothing_else():
    """Compared with the law evaluated from the motion that MuJoCo made."""
    cut = setup(order=1, step_s=0.005)
    model, _, rows = steps(cut)
    h = model.opt.timestep
    for before, after, torques, _ in rows:
        expected = viscous_joint_torques(cut.nodes_mm * 1e-3, (after - before) / h)
        assert np.abs(expected).max() > 1e-5
        # The servo is 1e6 stiffer than the shaft: rounding of its 1e3 N m / rad at 1 rad is 1e-13.
        assert torques.tissue == pytest.approx(expected, abs=1e-11)
        assert not torques.other.any()
        assert not torques.correction.any()


def test_a_second_order_step_is_corrected_and_the_correction_falls_with_the_step():
    """What lifts a step to second order is of the order of the step."""

    def largest(h):
        _, _, rows = steps(setup(step_s=h), count=round(0.2 / h))
        return np.abs(rows[-1][2].correction).max()

    coarse, fine = largest(0.01), largest(0.005)
    assert coarse > 1e-7
    assert coarse / fine == pytest.approx(2.0, rel=0.25)


@pytest.mark.parametrize(
    ("fields", "slides"),
    [({"drive": Drive(backlash_deg=4.0)}, 0.0), ({}, 2.5)],
    ids=["play of the drive", "a free length that grows"],
)
def test_play_and_a_growing_free_length_are_told_apart_from_the_tissue(fields, slides):
    _, _, rows = steps(setup(order=1, **fields), slide_mm_s=slides)
    assert np.abs(rows[-1][2].other).max() > 1e-7
    assert not rows[-1][2].correction.any()


def test_a_joint_of_the_chain_turns_all_that_lies_beyond_it(interpreted):
    nodes = np.array([1.0, 2.0, 4.0])
    interpreted.torques.to_joints(True, nodes)
    assert nodes.tolist() == [7.0, 6.0, 4.0]
    interpreted.torques.to_joints(False, nodes)
    assert nodes.tolist() == [7.0, 6.0, 4.0]  # siblings: each its own


@pytest.mark.parametrize(("order", "tolerance"), [(3, 0.01), (2, 0.01), (1, 0.15)])
def test_the_base_torque_of_a_heavy_shaft_is_its_inertia(order, tolerance):
    """Hardly any tissue: T = I alpha. The centred second difference of a motion at w = 4 pi rad/s is
    within (w h)^2 / 12 = 0.13 %; a first-order step lags by h / 2 on top, w h = 0.13."""
    heavy = NITINOL.but(name="rod", diameter_mm=10.0, shear_modulus_gpa=80.0, density_g_cm3=8.0)
    time = np.arange(0.0, 2.0, 0.01)
    turned = 20 * np.sin(2 * np.pi * time) ** 2
    made = Setup(
        needle=heavy,
        tissue=Tissue.uniform(viscous_n_mm_s_per_mm=1e-9),
        discretisation=Discretisation(elements=4, order=order),
        free_mm=100,
        inserted_mm=200,
    )
    inputs = Schedule(
        time_s=time,
        drive=turned,
        free_mm=np.full(time.size, 100.0),
        inserted_mm=np.full(time.size, 200.0),
        speed_mm_s=np.zeros(time.size),
    )
    run = simulate([made], inputs)[0]
    inertia = 8000 * np.pi / 32 * 0.01**4 * 0.3
    alpha = np.radians(20) * 8 * np.pi**2 * np.cos(4 * np.pi * time)
    expected = 1e3 * inertia * alpha
    inner = slice(20, -5)  # it starts from rest with a jump of the acceleration
    error = run.base_torque_n_mm[inner] - expected[inner]
    assert np.sqrt(np.mean(error**2)) < tolerance * np.sqrt(np.mean(expected**2))
