"""A tip that is held by the kerf which it has cut, against closed forms.

Turned steadily at a rate w while the needle moves at a speed v, tip and base turn alike, and as the
twisted shaft moves on, its tip turns back by v T / rigidity. The torque T = k phi of a kerf, as yet far
from its most, obeys

    w = |v| T / (k travel) + v T / rigidity.

At rest it is a spring in series with the shaft. As the needle moves on without turning, the tip follows
the base: with a shaft of stiffness c, T fades over (1 + k / c) / (1 / travel + k / rigidity).
"""

import math

import numpy as np
import pytest

from models.kerf import Kerf
from models.needle import Needle
from models.tissue import Interface, Layer, Tissue
from sim.discretisation import Arrangement, Discretisation
from sim.kernel import memory_map
from sim.needles.run import Run
from sim.needles.setup import Setup
from sim.schedule import Schedule
from sim.simulation import simulate

NEEDLE = Needle(diameter_mm=0.59, shear_modulus_gpa=27.2, density_g_cm3=6.45)
FREE_MM, INSERTED_MM, K_N_MM_PER_RAD, TRAVEL_MM = 10.0, 60.0, 5.0, 4.0
FAR_RAD = 1e3  # the kerf is straight: its torque is 5000 N mm at most
SHAFT_N_MM_PER_RAD = NEEDLE.rigidity_n_mm2 / (FREE_MM + INSERTED_MM)
STEP_S, STARTS_S, MOVED_MM = 0.005, 3.0, 8.0
STRAIGHT = Kerf(
    torque_n_mm=K_N_MM_PER_RAD * FAR_RAD, angle_deg=math.degrees(FAR_RAD), travel_mm=TRAVEL_MM
)


def run_of(time_s: np.ndarray, drive_deg: np.ndarray, speed_mm_s: np.ndarray, kerf: Kerf) -> Run:
    """A run in tissue that slides along a needle which is held at its tip alone."""
    none = Layer(interface=Interface(viscous_n_mm_s_per_mm=1e-9))
    setup = Setup(
        needle=NEEDLE,
        tissue=Tissue(layers=(none,), kerfs=(kerf,)),
        free_mm=FREE_MM,
        inserted_mm=INSERTED_MM,
        discretisation=Discretisation(elements=16, step_s=STEP_S, arrangement=Arrangement.SIBLINGS),
    )
    inputs = Schedule(
        time_s=time_s,
        drive=drive_deg,
        free_mm=np.full(time_s.shape, FREE_MM),
        inserted_mm=np.full(time_s.shape, INSERTED_MM),
        speed_mm_s=speed_mm_s,
    )
    return simulate([setup], inputs)[0]


@pytest.mark.parametrize("speed_mm_s", [3.0, -3.0])
def test_turned_while_it_slides_its_torque_is_that_of_the_lag(speed_mm_s: float) -> None:
    rate = 0.4
    time_s = np.linspace(0.0, 60.0, 6001)
    run = run_of(time_s, np.degrees(rate) * time_s, np.full(time_s.shape, speed_mm_s), STRAIGHT)
    per_torque = abs(speed_mm_s) / (K_N_MM_PER_RAD * TRAVEL_MM) + speed_mm_s / NEEDLE.rigidity_n_mm2
    assert run.base_torque_n_mm[-1] == pytest.approx(rate / per_torque, rel=1e-5)


@pytest.mark.parametrize("angle_deg", [None, 20.0])
def test_at_rest_shaft_and_kerf_bear_the_same_torque(angle_deg: float | None) -> None:
    """The twist of the shaft, and the angle from the kerf, are that of the base."""
    kerf = Kerf(torque_n_mm=3.0, angle_deg=angle_deg, travel_mm=TRAVEL_MM)
    time_s, turned_deg = np.linspace(0.0, 6.0, 601), 50.0
    run = run_of(time_s, np.minimum(25.0 * time_s, turned_deg), np.zeros(time_s.shape), kerf)
    phi_deg = float(run.tip_deg[-1])
    share = math.tanh(phi_deg / angle_deg) if angle_deg else math.sin(math.radians(phi_deg))
    assert run.base_torque_n_mm[-1] == pytest.approx(3.0 * share, rel=1e-5)
    twist_rad = math.radians(turned_deg - phi_deg)
    assert run.base_torque_n_mm[-1] == pytest.approx(SHAFT_N_MM_PER_RAD * twist_rad, rel=1e-5)


def test_without_a_turn_the_twist_fades_with_the_distance() -> None:
    """As far at two speeds: the same is left; a speed begins within a step of 5 ms, or 0.02 mm."""
    slower = 1.0 + K_N_MM_PER_RAD / SHAFT_N_MM_PER_RAD
    fading_mm = slower / (1.0 / TRAVEL_MM + K_N_MM_PER_RAD / NEEDLE.rigidity_n_mm2)
    for speed_mm_s in (1.0, 4.0):
        time_s = np.arange(0.0, STARTS_S + MOVED_MM / speed_mm_s, STEP_S)
        moving = np.where(time_s > STARTS_S, speed_mm_s, 0.0)
        run = run_of(time_s, np.minimum(20.0 * time_s, 40.0), moving, STRAIGHT)
        left = run.base_torque_n_mm[-1] / run.base_torque_n_mm[np.searchsorted(time_s, STARTS_S)]
        tolerance = 2 * STEP_S * speed_mm_s / fading_mm
        assert left == pytest.approx(math.exp(-MOVED_MM / fading_mm), rel=tolerance)


def test_on_the_way_back_a_tip_may_find_its_kerf() -> None:
    """Drawn back at rest, the tip stays where it is; pushed on, it follows."""
    kerf = STRAIGHT.but(backwards=0.0)
    time_s = np.arange(0.0, STARTS_S + 4.0, STEP_S)
    drive_deg, moving = np.minimum(20.0 * time_s, 40.0), time_s > STARTS_S
    back, onwards = (
        run_of(time_s, drive_deg, np.where(moving, speed, 0.0), kerf).base_torque_n_mm
        for speed in (-2.0, 2.0)
    )
    before = np.searchsorted(time_s, STARTS_S)
    assert abs(back[-1]) > 0.9 * back[before]
    assert abs(onwards[-1]) < 0.5 * onwards[before]


def test_what_the_drive_puts_in_is_stored_or_lost() -> None:
    """At rest nothing is lost but in the tissue that hardly damps; on the move, what is cut anew."""
    kerf = Kerf(torque_n_mm=1.0, angle_deg=20.0, travel_mm=TRAVEL_MM)
    time_s = np.linspace(0.0, 6.0, 1201)
    drive_deg = 60.0 * np.sin(2.0 * time_s)
    columns = [memory_map.O_WORK, memory_map.O_TISSUE_ENERGY, memory_map.O_SHAFT_ENERGY]
    for speed_mm_s, share in ((0.0, 1e-3), (2.0, 0.9)):
        run = run_of(time_s, drive_deg, np.full(time_s.shape, speed_mm_s), kerf)
        work, tissue, shaft = run.outputs[:, columns].T
        lost = run.outputs[:, memory_map.O_DISSIPATED]
        assert np.abs(work - tissue - shaft - lost).max() < 5e-3 * np.abs(work).max()
        assert (lost[-1] < share * tissue.max()) == (speed_mm_s == 0.0)
