"""Trials of the rig against closed forms, and what its sensors read.

Bounds for the rig's own error are 0.02 deg and 0.002 N mm: a twentieth of 0.4 deg and an eighth of
0.015 N mm, the noise of a rig's sensors.
"""

import math
from dataclasses import replace

import numpy as np
import pytest

from models.modes import InsertedNeedle
from models.needle import NITINOL
from validation.rig.simulation import COARSE, CellCounts, compile_kernels, ideal_signals, simulate_twist

BETA, DEPTH, FREE = 0.018, 100.0, 80.0  # of the fixtures `make_rig` and `drive`
KAPPA = NITINOL.rigidity_n_mm2
TIP_DEG, TORQUE_N_MM = 0.02, 0.002


def closed_form(motion):
    """Tip, deg, and torque, N mm, of the modal solution; exact for a base that is linear in samples."""
    needle = InsertedNeedle(needle=NITINOL, damping_n_mm_s_per_mm=BETA, inserted_mm=DEPTH, free_mm=FREE)
    exact = needle.respond(motion.time_s, np.radians(motion.base_deg), count=200)
    return np.degrees(exact.tip_rad), exact.base_torque_n_mm


def test_the_nominal_rig_follows_the_modes(drive, make_rig):
    motion = drive()
    signals = ideal_signals(make_rig(), motion)
    tip, torque = closed_form(motion)
    assert np.ptp(torque) > 1
    assert signals.tip_deg == pytest.approx(tip, abs=TIP_DEG)
    assert signals.torque_n_mm == pytest.approx(torque, abs=TORQUE_N_MM)


@pytest.mark.parametrize("refined", ["steps", "cells"])
def test_errors_fall_with_the_square_of_steps_and_of_cells(drive, make_rig, refined):
    errors = []
    for part in (1, 2):
        motion = drive(dt=0.02 / part if refined == "steps" else 0.00125)
        cells = CellCounts(200 if refined == "steps" else 10 * part, 0, 0)
        tip, _ = simulate_twist(make_rig().law(), motion, cells)
        # The closed form moves straight between samples: compare on fine ones, where that is exact.
        exact, _ = closed_form(drive(dt=0.00125))
        errors.append(np.abs(np.degrees(tip) - exact[:: round(motion.dt_s / 0.00125)]).max())
    # 4 in the limit; a first-order method would give 2.
    assert 3.2 < errors[0] / errors[1] < 4.8


def test_steady_turning_lags_as_computed_by_hand(drive, make_rig, turn_steadily):
    signals = ideal_signals(make_rig(), drive(turn_steadily, end=12))
    rate = math.radians(60)
    lag = BETA * rate * DEPTH * (DEPTH / 2 + FREE) / KAPPA
    assert signals.torque_n_mm[-1] == pytest.approx(BETA * rate * DEPTH, rel=1e-4)
    assert signals.base_deg[-1] - signals.tip_deg[-1] == pytest.approx(math.degrees(lag), rel=1e-4)


def test_a_mirrored_drive_gives_the_mirrored_motion(drive, make_rig, swing):
    """Every law but the one-way ones is odd; the two runs differ by Newton's 1e-7 rad at most."""
    rig = make_rig(stiction={"kinetic": 0.002, "static": 0.004, "stribeck": 0.4})
    one = ideal_signals(rig, drive(dt=0.01))
    other = ideal_signals(rig, drive(lambda time_s: -swing(time_s), dt=0.01))
    assert other.tip_deg == pytest.approx(-one.tip_deg, abs=1e-5)


def test_tip_torque_and_drive_torque_balance_the_friction(drive, make_rig):
    """Held still, the drive carries the torque at the tip alone: nothing else acts at rest."""
    motion = drive(
        lambda time_s: np.zeros_like(time_s), end=20.0, dt=0.01, load=lambda time_s: 1.5 + 0 * time_s
    )
    signals = ideal_signals(make_rig(), motion)
    assert signals.torque_n_mm[-1] == pytest.approx(1.5, abs=TORQUE_N_MM)
    twist = -math.degrees(1.5 * (DEPTH + FREE) / KAPPA)
    assert signals.tip_deg[-1] == pytest.approx(twist, abs=TIP_DEG)


def test_coarse_cells_are_good_enough_for_a_search(drive, make_rig):
    """Second order: a third of the cells leaves nine times the error of the fine rig, 0.18 deg."""
    fine, coarse = (ideal_signals(make_rig(), drive(), *cells) for cells in ((), (COARSE,)))
    difference = np.abs(coarse.tip_deg - fine.tip_deg).max()
    assert 0 < difference < 9 * TIP_DEG


def test_sensors_err_as_their_effects_say(drive, make_rig):
    motion = drive()
    true = ideal_signals(make_rig(), motion)
    biased = ideal_signals(make_rig(tip_angle_bias={"bias": 2.0}, torque_bias={"bias": -0.1}), motion)
    assert biased.tip_deg == pytest.approx(true.tip_deg + 2)
    assert biased.torque_n_mm == pytest.approx(true.torque_n_mm - 0.1)
    late = ideal_signals(
        make_rig(tip_sensor_delay={"delay": 0.05}, tip_angle_scale={"scale": 0.9}), motion
    )
    assert late.tip_deg[20:] == pytest.approx(0.9 * true.tip_deg[:-20])


def test_a_trial_without_a_balance_says_when(drive, make_rig):
    motion = drive(end=0.1)
    broken = replace(motion, base_deg=np.where(motion.time_s > 0.05, np.nan, 0.0))
    with pytest.raises(RuntimeError, match=r"no balance of torques was found at 0\.05"):
        simulate_twist(make_rig().law(), broken)


def test_kernels_are_compiled_for_the_types_of_every_rig(drive, make_rig):
    from validation.rig.integrator import integrate

    compile_kernels()
    compiled = len(integrate.signatures)
    ideal_signals(make_rig(sheath_friction={"level": 0.002}), drive(end=0.1, speed=1.0, growing=True))
    assert len(integrate.signatures) == compiled == 1
