"""Runs of a needle of one length, which dry friction holds at its tip unless it is in other tissue."""

import numpy as np

from models.tissue import Interface, Layer, Tissue
from sim.discretisation import Discretisation
from sim.needles.setup import Setup
from sim.schedule import Schedule
from sim.simulation import simulate

LEVEL_N_MM = 1.5
FREE_MM, INSERTED_MM = 20.0, 60.0
HELD = Tissue(
    layers=(Layer(interface=Interface()),), at_tip=(Interface(kinetic_n_mm_per_mm=LEVEL_N_MM),)
)


def run_of(drive_deg, time_s, needle, tissue=HELD):
    """The run of a base that turns so."""
    setup = Setup(
        needle=needle,
        tissue=tissue,
        free_mm=FREE_MM,
        inserted_mm=INSERTED_MM,
        discretisation=Discretisation(elements=6, step_s=float(time_s[1] - time_s[0])),
    )
    inputs = Schedule(
        time_s=time_s,
        drive=drive_deg,
        free_mm=np.full(time_s.shape, FREE_MM),
        inserted_mm=np.full(time_s.shape, INSERTED_MM),
        speed_mm_s=np.zeros(time_s.shape),
    )
    return simulate([setup], inputs)[0]
