"""The needle of MuJoCo's own parts against lumped closed forms and dense matrices."""

import os
import subprocess
import sys
from pathlib import Path

import mujoco
import numpy as np
import pytest

from models import lumped
from models.drive import DriveKind
from models.modes import InsertedNeedle
from models.needle import NITINOL
from sim.simulation import simulate
from studies.crosscheck import motion, native_needle, poles

ROOT = Path(__file__).parents[3]
DAMPING, LENGTH_MM = 0.01725, 200.0


def rig(kind=DriveKind.ANGLE, free_mm=0.0, needle=NITINOL, damping=DAMPING):
    return InsertedNeedle(
        needle=needle,
        damping_n_mm_s_per_mm=damping,
        inserted_mm=LENGTH_MM,
        free_mm=free_mm,
        drive=kind,
    )


@pytest.mark.parametrize("elements", [8, 64])
def test_torque_driven_poles_are_those_of_the_lumped_needle(elements):
    """Free at both ends, half masses there make no difference: x = k pi / 2n in both."""
    free = rig(DriveKind.TORQUE)
    expected = lumped.poles_rad_s(free, masses=elements, count=5)[1:]
    assert poles.measure_native(free, 4, elements=elements) == pytest.approx(expected, rel=1e-6)


@pytest.mark.parametrize("elements", [8, 64])
def test_base_driven_poles_are_the_continuous_ones_times_sine_x_over_x_squared(elements):
    x = (np.arange(4) + 0.5) * np.pi / (2 * elements)
    expected = rig().poles_rad_s(4) * (np.sin(x) / x) ** 2
    # Without inertia, which shifts the fourth pole by eta |p| / beta = 2.5e-7.
    assert poles.measure_native(rig(), 4, elements=elements) == pytest.approx(expected, rel=1e-6)


def test_the_stated_bound_holds_for_coarse_needles_with_a_free_length_too():
    """Where lumping is not lost in other errors: 16 elements, 5 %."""
    for kind in DriveKind:
        for free_mm in (0.0, 50.0, 200.0):
            case = rig(kind, free_mm)
            exact = case.poles_with_inertia_rad_s(5)
            off = poles.measure_native(case, 4, elements=16) / exact[exact < 0][:4] - 1
            bounds = [native_needle.pole_bound(mode, 16) for mode in (1, 2, 3, 4)]
            assert np.all(np.abs(off) < bounds)
            assert off[-1] < -0.3 * bounds[-1]


@pytest.mark.parametrize("free_mm", [0.0, 50.0])
def test_half_the_stiffness_gives_half_the_poles(free_mm):
    soft = NITINOL.but(shear_modulus_gpa=NITINOL.shear_modulus_gpa / 2)
    stiff, half = (
        poles.measure_native(rig(free_mm=free_mm, needle=needle), 4, elements=16)
        for needle in (NITINOL, soft)
    )
    assert half == pytest.approx(stiff / 2, rel=1e-6)


def dense_backward_euler(case, drive, step_s, elements):
    """Nodes from assembled matrices: M (v' - v) / h + D v' + K q' = f', q' = q + h v'."""
    lengths = [case.free_mm] * (case.free_mm > 0) + [case.inserted_mm / elements] * elements
    covered = np.array([0.0] * (case.free_mm > 0) + [1.0] * elements)
    nodes = len(lengths) + 1
    mass, damping, stiffness = (np.zeros((nodes, nodes)) for _ in range(3))
    for i, length in enumerate(lengths):
        ends = np.ix_([i, i + 1], [i, i + 1])
        mass[ends] += case.needle.rotary_inertia_kg_m * length / 2 * np.eye(2)
        damping[ends] += case.damping_n_mm_s_per_mm * covered[i] * length / 2 * np.eye(2)
        stiffness[ends] += case.needle.rigidity_n_mm2 / length * np.array([[1, -1], [-1, 1]])
    moving = np.arange(case.drive is DriveKind.ANGLE, nodes)
    load = -stiffness[moving, 0] if case.drive is DriveKind.ANGLE else np.eye(nodes)[0]
    mass, damping, stiffness = (m[np.ix_(moving, moving)] for m in (mass, damping, stiffness))
    angles, rates, rows = np.zeros(moving.size), np.zeros(moving.size), []
    for u in drive:
        left = mass / step_s + damping + step_s * stiffness
        rates = np.linalg.solve(left, mass @ rates / step_s - stiffness @ angles + load * u)
        angles = angles + step_s * rates
        rows.append(angles)
    return np.array(rows)


@pytest.mark.parametrize("kind", list(DriveKind))
@pytest.mark.parametrize("free_mm", [0.0, 50.0])
def test_from_rest_every_step_is_one_of_backward_euler(kind, free_mm):
    """From the first step on: stiffness of a shaft that is exactly at rest counts too."""
    drive = np.sin(np.arange(1, 41))
    case = rig(kind, free_mm)
    found = native_needle.respond(case, drive, step_s=0.02, elements=12)
    expected = dense_backward_euler(case, drive, 0.02, 12)
    assert np.abs(expected[0]).min() > 1e-9  # the tip moves in the first step
    assert found == pytest.approx(expected, rel=1e-8, abs=1e-10)


def test_at_a_constant_torque_it_turns_at_torque_over_b_and_twists_by_both_lengths():
    torque, case = 2.0, rig(DriveKind.TORQUE, free_mm=50.0)
    angles = native_needle.respond(case, np.full(400, torque), step_s=0.05, elements=32)
    # MuJoCo's iteration leaves 2e-8 of the rate.
    assert angles[-1] - angles[-2] == pytest.approx(0.05 * torque / case.damping_n_mm_s, rel=1e-7)
    twist = torque * (50.0 + LENGTH_MM / 2) / NITINOL.rigidity_n_mm2
    assert angles[-1, 0] - angles[-1, -1] == pytest.approx(twist, rel=1e-8)


def test_extrapolated_steps_are_second_order():
    time = np.linspace(0, 2, 51)
    base = np.radians(45) * (1 - np.cos(np.pi * time / 2))
    errors = [
        np.abs(
            native_needle.tip_rad(rig(), time, base, substeps=n)
            - native_needle.tip_rad(rig(), time, base, substeps=16)
        ).max()
        for n in (1, 2)
    ]
    # Against 16 substeps: (1 - 1/256) / (1/4 - 1/256) = 4.05 where the error goes as h^2.
    assert errors[0] / errors[1] == pytest.approx(4.05, rel=0.05)


@pytest.mark.parametrize("kind", list(DriveKind))
def test_mujoco_warns_of_nothing(kind, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    model = native_needle.native_spec(rig(kind, 50.0), step_s=0.0025).compile()
    data = mujoco.MjData(model)
    for _ in range(200):
        data.ctrl[0] = 1.0
        mujoco.mj_step(model, data)
    assert data.qpos[-1] > 1e-3
    assert [warning.number for warning in data.warning] == [0] * len(data.warning)
    assert list(tmp_path.iterdir()) == []


ALONE = """
import sys
import mujoco
import numpy as np
from models.modes import InsertedNeedle
from models.needle import NITINOL
from studies.crosscheck import native_needle

case = InsertedNeedle(needle=NITINOL, damping_n_mm_s_per_mm=0.01725, inserted_mm=200.0)
tip = native_needle.respond(case, np.ones(20), step_s=0.05)[-1, -1]
assert mujoco.get_mjcb_passive() is None and mujoco.get_mjcb_sensor() is None
assert not [name for name in sys.modules if name.split(".")[0] == "sim"]
print(repr(float(tip)))
"""


def test_it_needs_no_callback_and_is_the_same_beside_ours():
    simulate([motion.viscous_setup(elements=8, step_s=0.1)], motion.fast_turn())
    assert mujoco.get_mjcb_passive() is not None
    beside = native_needle.respond(rig(), np.ones(20), step_s=0.05)[-1, -1]
    alone = subprocess.run(
        [sys.executable, "-c", ALONE],
        cwd=ROOT,
        env=os.environ | {"PYTHONPATH": str(ROOT)},
        capture_output=True,
        text=True,
        check=True,
    )
    assert float(alone.stdout) == beside
