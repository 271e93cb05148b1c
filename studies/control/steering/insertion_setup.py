"""A needle that is inserted at constant speed: its set-up and its schedule."""

import numpy as np

from models.needle import NITINOL
from models.tissue import Tissue
from sim.discretisation import Discretisation, Mesh
from sim.needles.setup import Setup
from sim.schedule import Schedule


def lagrangian_setup(
    tissue: Tissue, *, free_mm: float, inserted_mm: float, step_s: float, elements: int
) -> Setup:
    """The paper's needle on a mesh that is fixed to it."""
    return Setup(
        needle=NITINOL,
        tissue=tissue,
        discretisation=Discretisation(step_s=step_s, elements=elements),
        mesh=Mesh.LAGRANGIAN,
        free_mm=free_mm,
        inserted_mm=inserted_mm,
    )


def constant_speed(*, start_mm: float, travel_mm: float, speed_mm_s: float, free_mm: float) -> Schedule:
    """An insertion without any turn.

    Args:
      start_mm: inserted length at the start.
      free_mm: free length between chuck and tissue at the end.
    """
    time = np.array([0.0, travel_mm / speed_mm_s])
    travelled = speed_mm_s * time
    return Schedule(
        time_s=time,
        drive=np.zeros(2),
        free_mm=free_mm + travel_mm - travelled,
        inserted_mm=start_mm + travelled,
        speed_mm_s=np.full(2, speed_mm_s),
    )
