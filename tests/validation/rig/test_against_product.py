"""The independent rig against the MuJoCo needle of `sim`: two simulations that share no code."""

import numpy as np
import pytest

from models.needle import NITINOL
from models.tissue import Tissue
from sim.discretisation import Arrangement, Discretisation
from sim.needles.setup import Setup
from sim.schedule import Schedule
from sim.simulation import simulate
from validation.rig.simulation import ideal_signals

BETA = 0.018
ELEMENTS, STEP_S = 12, 0.005
TIP_DEG, TORQUE_N_MM = 0.02, 0.001


def base(time_s):
    return np.interp(time_s, [0, 0.5, 1.1, 4, 5, 8], [0, 0, 90, 90, -20, -20])


def product(motion, level):
    """Tip, deg, and base torque, N mm, of the MuJoCo needle with Coulomb friction of that level."""
    schedule = Schedule(
        time_s=motion.time_s,
        drive=motion.base_deg,
        free_mm=motion.free_mm,
        inserted_mm=motion.inserted_mm,
        speed_mm_s=motion.speed_mm_s,
    )
    setup = Setup(
        needle=NITINOL.but(length_mm=float(schedule.longest_mm)),
        tissue=Tissue.uniform(viscous_n_mm_s_per_mm=BETA, kinetic_n_mm_per_mm=level),
        discretisation=Discretisation(
            step_s=STEP_S,
            elements=2 * ELEMENTS if motion.growing else ELEMENTS,
            arrangement=Arrangement.SIBLINGS,
        ),
        mesh=schedule.mesh,
        free_mm=float(motion.free_mm[0]),
        inserted_mm=float(motion.inserted_mm[0]),
        # The independent rig's tissue resists the material where the depth grows, else the place.
        slip_share=1.0 if motion.growing else 0.0,
    )
    run = simulate([setup], schedule)[0]
    return run.tip_deg, run.base_torque_n_mm


def rms(values):
    return np.sqrt(np.mean(values**2))


@pytest.mark.parametrize("growing", [False, True])
@pytest.mark.parametrize("level", [0.0, 0.0015], ids=["viscous", "dry"])
def test_both_agree_to_a_tenth_of_the_least_noise_of_a_rig(drive, make_rig, level, growing):
    """0.02 deg of tip and 0.001 N mm of torque: a tenth of 0.2 deg and of 0.01 N mm."""
    moved = drive(base, dt=STEP_S, end=8.0, speed=1.5 * growing, growing=growing, depth=80.0, free=70.0)
    signals = ideal_signals(make_rig(coulomb_friction={"level": level}), moved)
    tip, torque = product(moved, level)
    assert rms(tip - signals.tip_deg) < TIP_DEG
    assert rms(torque - signals.torque_n_mm) < TORQUE_N_MM
    # Negative control: 0.2 mN mm per mm of dry friction more would be seen.
    other, _ = product(moved, level + 2e-4)
    assert rms(other - signals.tip_deg) > 0.05
