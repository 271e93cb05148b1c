"""A chuck that works loose, against the same needle with and without play."""

import numpy as np
import pytest

from models.drive import Drive
from models.loosening import Loosening
from models.needle import Needle
from models.tissue import Tissue
from sim.discretisation import Arrangement, Discretisation
from sim.needles.run import Run
from sim.needles.setup import Setup
from sim.schedule import Schedule
from sim.simulation import simulate

NEEDLE = Needle(diameter_mm=0.59, shear_modulus_gpa=27.2, density_g_cm3=6.45)
TIME_S, PLAY_DEG, FROM_S = np.linspace(0.0, 12.0, 1201), 6.0, 4.0


def run_of(drive: Drive, drive_deg: np.ndarray) -> Run:
    setup = Setup(
        needle=NEEDLE,
        tissue=Tissue.uniform(viscous_n_mm_s_per_mm=0.017),
        drive=drive,
        free_mm=10.0,
        inserted_mm=60.0,
        discretisation=Discretisation(elements=16, step_s=0.01, arrangement=Arrangement.SIBLINGS),
    )
    inputs = Schedule(
        time_s=TIME_S,
        drive=drive_deg,
        free_mm=np.full(TIME_S.shape, 10.0),
        inserted_mm=np.full(TIME_S.shape, 60.0),
        speed_mm_s=np.zeros(TIME_S.shape),
    )
    return simulate([setup], inputs)[0]


def loosened(over_s: float = 0.1) -> Drive:
    return Drive(loosens=Loosening(play_deg=PLAY_DEG, from_s=FROM_S, over_s=over_s))


def test_turned_steadily_the_needle_falls_back_by_half_of_the_play() -> None:
    """Before it opens there is none; the step that ends just after it begins may know of it."""
    turning = 30.0 * TIME_S
    firm, loose = run_of(Drive(), turning), run_of(loosened(), turning)
    before = TIME_S < FROM_S - 0.01
    np.testing.assert_array_equal(loose.tip_deg[before], firm.tip_deg[before])
    # After 8 s, thirty of the slowest time constants of 0.25 s at most, it lags steadily again.
    assert firm.tip_deg[-1] - loose.tip_deg[-1] == pytest.approx(0.5 * PLAY_DEG, rel=1e-6)
    assert loose.base_torque_n_mm[-1] == pytest.approx(firm.base_torque_n_mm[-1], rel=1e-6)


def test_once_open_it_is_the_play_of_a_chuck() -> None:
    """Turned to and fro after that, as one that had this play from the start."""
    to_and_fro = np.where(TIME_S < FROM_S, 0.0, 40.0 * np.sin(1.5 * (TIME_S - FROM_S)))
    open_before = Drive(loosens=Loosening(play_deg=PLAY_DEG, from_s=0.0, over_s=0.1))
    later = TIME_S > FROM_S
    plain = run_of(Drive(backlash_deg=PLAY_DEG), to_and_fro)
    for drive in (open_before, Drive(backlash_deg=2.0, loosens=Loosening(play_deg=4.0, from_s=0.0))):
        found = run_of(drive, to_and_fro)
        np.testing.assert_allclose(found.tip_deg[later], plain.tip_deg[later], atol=1e-6)
    firm = run_of(Drive(), to_and_fro)
    assert np.abs(plain.tip_deg - firm.tip_deg)[later].max() > 1.0
