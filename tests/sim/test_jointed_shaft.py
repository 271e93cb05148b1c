"""A joint in the shaft, with play or a spring, against closed forms.

The shaft is so stiff that each part of it turns as one (its twist is below 0.02 deg). What lies beyond
the joint stays until half of the play is taken up, then follows by so much less; after a reversal it
stays until all of it is.
"""

from itertools import pairwise

import numpy as np
import pytest

from models.errors import InvalidValue
from models.needle import NITINOL
from models.tissue import Tissue
from sim.discretisation import Arrangement, Discretisation
from sim.kernel import memory_map
from sim.needles.setup import Setup
from sim.schedule import Schedule
from sim.simulation import simulate

STIFF = NITINOL.but(shear_modulus_gpa=1e6)
VISCOUS = Tissue.uniform(viscous_n_mm_s_per_mm=0.02)
PLAY_DEG, STEP_S = 8.0, 0.01
TWIST_DEG = 0.02  # of the shaft itself
ARRANGEMENTS = pytest.mark.parametrize("arrangement", list(Arrangement))


def turned(drive_deg, *, from_tip_mm, arrangement=Arrangement.SIBLINGS, play_deg=PLAY_DEG, elements=8):
    time_s = STEP_S * np.arange(drive_deg.size)
    same = np.ones(time_s.size)
    setup = Setup(
        needle=STIFF.but(joint_play_deg=play_deg, joint_from_tip_mm=from_tip_mm),
        tissue=VISCOUS,
        free_mm=10.0,
        inserted_mm=60.0,
        discretisation=Discretisation(elements=elements, step_s=STEP_S, arrangement=arrangement),
    )
    inputs = Schedule(
        time_s=time_s,
        drive=drive_deg,
        free_mm=10.0 * same,
        inserted_mm=60.0 * same,
        speed_mm_s=0.0 * same,
    )
    return simulate([setup], inputs)[0]


@ARRANGEMENTS
@pytest.mark.parametrize("from_tip_mm", [5.0, 31.0, 64.0])
def test_the_tip_follows_by_half_of_the_play_less_and_by_half_more_after_a_reversal(
    arrangement, from_tip_mm
):
    drive_deg = np.concatenate([np.linspace(0, 60, 300), np.linspace(60, 0, 300)])
    run = turned(drive_deg, from_tip_mm=from_tip_mm, arrangement=arrangement)
    base = run.base_deg
    forth = (base > PLAY_DEG) & (run.time_s < 3.0)
    back = (base < 60 - 2 * PLAY_DEG) & (run.time_s > 3.0)
    np.testing.assert_allclose(base[forth] - run.tip_deg[forth], PLAY_DEG / 2, atol=TWIST_DEG)
    np.testing.assert_allclose(run.tip_deg[back] - base[back], PLAY_DEG / 2, atol=TWIST_DEG)


def moves_deg(drive_deg, elements, from_tip_mm):
    """By how much the tip moves while the play is taken up after a reversal."""
    run = turned(drive_deg, from_tip_mm=from_tip_mm, elements=elements)
    waits = (run.base_deg > 60 - 0.9 * PLAY_DEG) & (run.time_s > 3.01)
    return np.abs(run.tip_deg[waits] - (60 - PLAY_DEG / 2)).max()


@pytest.mark.parametrize("from_tip_mm", [5.0, 31.0])
def test_the_tip_waits_while_the_play_is_taken_up(from_tip_mm):
    """To first order in the elements: within that of the joint, rates run straight across it."""
    drive_deg = np.concatenate([np.linspace(0, 60, 300), np.linspace(60, 0, 300)])
    moves = [moves_deg(drive_deg, elements, from_tip_mm) for elements in (8, 16, 32)]
    assert all(0.4 < finer / coarser < 0.6 for coarser, finer in pairwise(moves))
    assert moves[-1] < 0.03 * PLAY_DEG


def test_near_the_chuck_the_needle_beyond_it_asks_for_no_torque_while_it_waits():
    drive_deg = np.linspace(0, 30, 300)
    run = turned(drive_deg, from_tip_mm=69.0)
    rate = np.radians(30.0) / (299 * STEP_S)
    waits, follows = run.base_deg < 0.4 * PLAY_DEG, run.base_deg > 0.6 * PLAY_DEG
    assert np.abs(run.base_torque_n_mm[waits][1:]).max() < 0.1 * 0.02 * 60.0 * rate
    np.testing.assert_allclose(run.base_torque_n_mm[follows], 0.02 * 60.0 * rate, rtol=1e-3)


@ARRANGEMENTS
def test_play_takes_no_work(arrangement):
    """Work of the drive = heat in the tissue + what the shaft stores.

    Play that is taken up within a step leaves the torque of that step open: one of some 150 in a half
    wave, near its turning point, where the drive is slow.
    """
    run = turned(40 * np.sin(0.02 * np.arange(600)), from_tip_mm=31.0, arrangement=arrangement)
    work, heat = run.outputs[-1, [memory_map.O_WORK, memory_map.O_DISSIPATED]]
    assert work == pytest.approx(heat + run.outputs[-1, memory_map.O_SHAFT_ENERGY], rel=2e-3)
    without = turned(40 * np.sin(0.02 * np.arange(600)), from_tip_mm=31.0, play_deg=0.0)
    assert work < 0.99 * without.outputs[-1, memory_map.O_WORK]


@pytest.mark.parametrize("more", [{"yield_torque_n_mm": 1.0}, {"creep_ratio": 0.1, "creep_time_s": 1.0}])
def test_a_shaft_that_yields_or_creeps_has_no_joint(more):
    with pytest.raises(InvalidValue, match="joint_play_deg"):
        NITINOL.but(joint_play_deg=1.0, **more)


@ARRANGEMENTS
@pytest.mark.parametrize("from_tip_mm", [5.0, 31.0, 64.0])
def test_a_spring_twists_as_so_much_more_shaft(arrangement, from_tip_mm):
    """At a steady rate the tissue takes 0.02 N mm s / rad / mm: what lies beyond the spring loads it.

    The rest of the shaft twists by less than 0.02 deg. Two elements share the spring: its load is right
    to second order.
    """
    soft_mm, rate = 2e5, np.radians(30.0)
    time_s = STEP_S * np.arange(600)
    setup = Setup(
        needle=STIFF.but(joint_length_mm=soft_mm, joint_from_tip_mm=from_tip_mm),
        tissue=VISCOUS,
        free_mm=10.0,
        inserted_mm=60.0,
        discretisation=Discretisation(elements=12, step_s=STEP_S, arrangement=arrangement),
    )
    inputs = Schedule(
        time_s=time_s,
        drive=np.degrees(rate) * time_s,
        free_mm=np.full(600, 10.0),
        inserted_mm=np.full(600, 60.0),
        speed_mm_s=np.zeros(600),
    )
    run = simulate([setup], inputs)[0]
    beyond_n_mm = 0.02 * min(from_tip_mm, 60.0) * rate
    twist_deg = np.degrees(beyond_n_mm * soft_mm / STIFF.rigidity_n_mm2)
    assert run.base_deg[-1] - run.tip_deg[-1] == pytest.approx(twist_deg, rel=1e-2)
