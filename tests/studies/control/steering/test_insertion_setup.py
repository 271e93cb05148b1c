"""The set-up of a needle that goes in."""

import numpy as np
import pytest

from models.materials import MATERIALS
from sim.discretisation import Mesh
from studies.control.steering.insertion_setup import constant_speed, lagrangian_setup


def test_the_schedule_moves_at_its_speed_and_keeps_the_shaft_as_long_as_it_is():
    inputs = constant_speed(start_mm=40, travel_mm=30, speed_mm_s=5, free_mm=10)
    assert inputs.time_s[-1] == 6.0
    assert np.ptp(inputs.inserted_mm) == 30
    assert inputs.free_mm + inputs.inserted_mm == pytest.approx(80)
    assert (inputs.free_mm[-1], inputs.drive.any()) == (10, False)


def test_the_mesh_moves_with_the_needle():
    setup = lagrangian_setup(
        MATERIALS["viscous-plastisol"], free_mm=40, inserted_mm=40, step_s=0.01, elements=20
    )
    assert (setup.mesh, setup.discretisation.elements) == (Mesh.LAGRANGIAN, 20)
