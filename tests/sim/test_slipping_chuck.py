"""A chuck that slips, against closed forms: a stiff shaft in viscous tissue."""

import numpy as np
import pytest
from stiff_shaft import ARRANGEMENTS, LENGTH_MM, STEP_S, turned

from models.drive import Drive
from models.tissue import Tissue
from sim.kernel import memory_map


@ARRANGEMENTS
@pytest.mark.parametrize("rate", [1.5, -1.5])
def test_a_chuck_holds_its_torque_and_slips_by_the_rest(arrangement, rate):
    """In viscous tissue a needle that takes the torque T turns at T / (damping length)."""
    damping, grip = 0.02, 0.9
    time_s = np.arange(0, 4, STEP_S)
    drive_deg = np.degrees(rate) * time_s
    tissue = Tissue.uniform(viscous_n_mm_s_per_mm=damping)
    drive = Drive(grip_torque_n_mm=grip)
    run = turned(tissue, time_s, drive_deg, arrangement=arrangement, drive=drive)
    turns = grip / (damping * LENGTH_MM)
    assert turns < abs(rate)
    np.testing.assert_allclose(run.base_torque_n_mm[5:], np.sign(rate) * grip, rtol=1e-6)
    seconds = run.time_s[-1] - run.time_s[5]
    turned_deg = run.tip_deg[-1] - run.tip_deg[5]
    assert turned_deg == pytest.approx(np.degrees(np.sign(rate) * turns * seconds), rel=1e-6)
    slip = run.outputs[:, memory_map.O_CHUCK_SLIP]
    assert slip[-1] - slip[5] == pytest.approx((rate - np.sign(rate) * turns) * seconds, rel=1e-6)


@ARRANGEMENTS
@pytest.mark.parametrize("rate", [1.5, -1.5])
def test_a_spring_beside_the_grip_takes_up_the_rest_until_the_stop(arrangement, rate):
    """With damping D of the whole shaft, torque = grip + spring s and ds / dt = rate - torque / D:

    torque = D rate - (D rate - grip) exp(-spring t / D),    until s comes to the stop.
    """
    damping, grip, spring, stop_deg = 0.02 * LENGTH_MM, 0.5, 0.8, 60.0
    time_s = np.arange(0, 5, STEP_S)
    drive = Drive(grip_torque_n_mm=grip, grip_stiffness_n_mm_per_rad=spring, grip_play_deg=2 * stop_deg)
    tissue = Tissue.uniform(viscous_n_mm_s_per_mm=0.02)
    run = turned(tissue, time_s, np.degrees(rate) * time_s, arrangement=arrangement, drive=drive)
    left = (damping * abs(rate) - grip) * np.exp(-spring * run.time_s / damping)
    slip = (damping * abs(rate) - grip - left) / spring
    before = (slip < np.radians(stop_deg)) & (run.time_s > 5 * STEP_S)
    assert 20 < before.sum() < 0.9 * time_s.size
    exact = np.sign(rate) * (damping * abs(rate) - left)
    # The servo moves in steps: its first torque is late by half of one, 0.5 spring h / D.
    late = 0.5 * spring * STEP_S / damping
    np.testing.assert_allclose(run.base_torque_n_mm[before], exact[before], rtol=2 * late)
    stopped = run.time_s > run.time_s[before][-1] + 0.2
    np.testing.assert_allclose(run.base_torque_n_mm[stopped], damping * rate, rtol=1e-6)
    slip = run.outputs[stopped, memory_map.O_CHUCK_SLIP]
    np.testing.assert_allclose(slip, np.sign(rate) * np.radians(stop_deg), rtol=1e-9)


@pytest.mark.parametrize("more", [{}, {"grip_play_deg": 50}, {"grip_stiffness_n_mm_per_rad": 0.7}])
@ARRANGEMENTS
def test_what_slips_in_the_chuck_becomes_heat(arrangement, more):
    """Work of the drive = heat + what is stored; presliding stores 0.1 deg of 80, 1 part in 500."""
    time_s = np.arange(0, 6, STEP_S)
    tissue = Tissue.uniform(viscous_n_mm_s_per_mm=0.02, kinetic_n_mm_per_mm=0.002)
    drive_deg = 80.0 * np.sin(1.3 * time_s)
    last = {}
    for grip in (1.0, 100.0):
        drive = Drive(grip_torque_n_mm=grip, **more)
        run = turned(tissue, time_s, drive_deg, arrangement=arrangement, drive=drive)
        work, heat = run.outputs[-1, [memory_map.O_WORK, memory_map.O_DISSIPATED]]
        stored = run.outputs[-1, [memory_map.O_SHAFT_ENERGY, memory_map.O_TISSUE_ENERGY]].sum()
        assert work == pytest.approx(heat + stored, rel=2e-3)
        last[grip] = run
    if not more:
        assert abs(last[1.0].base_torque_n_mm).max() == pytest.approx(1.0, rel=1e-3)
    assert last[100.0].outputs[-1, memory_map.O_CHUCK_SLIP] == 0.0
    assert abs(last[1.0].outputs[:, memory_map.O_CHUCK_SLIP]).max() > 0.1
