"""A closed-loop run as a recording: the run's signals, the controller's, and the tip's path."""

import numpy as np
import pytest

from models.bevel import path_mm
from models.needle import NITINOL
from models.tissue import Tissue
from sim.closed_loop import run_closed_loop
from sim.discretisation import Discretisation, Mesh
from sim.needles.setup import Setup
from sim.schedule import Schedule
from studies.control.closed_loop_recording import record_closed_loop
from studies.control.step_response import DAMPING, DESIGN
from studies.control.tip_controllers import tip_controller_named


def controlled(advance_mm):
    time, depth = np.array([0.0, 0.2]), np.array([40.0, 40.0 + advance_mm])
    inputs = Schedule(
        time_s=time,
        drive=np.array([0.0, 60.0]),
        free_mm=90.0 - depth,
        inserted_mm=depth,
        speed_mm_s=np.full(2, advance_mm / 0.2),
    )
    setup = Setup(
        needle=NITINOL,
        tissue=Tissue.uniform(viscous_n_mm_s_per_mm=DAMPING),
        discretisation=Discretisation(elements=16, step_s=0.005),
        mesh=Mesh.LAGRANGIAN,
        free_mm=50,
        inserted_mm=40,
    )
    controller = tip_controller_named("feedforward", DESIGN)
    return run_closed_loop(setup, inputs, controller, log=controller.signals)


def test_reference_estimate_and_command_stand_beside_the_signals_of_the_run():
    made = controlled(0.0)
    recording = record_closed_loop(made, {"controller": "feedforward"})
    assert np.array_equal(recording["wanted_tip_deg"], made.reference_deg)
    assert np.array_equal(recording["estimate_tip_deg"], made.log["estimate_tip_deg"])
    assert np.array_equal(recording["tip_angle_deg"], made.run.tip_deg)
    assert recording["estimate_tip_deg"] == pytest.approx(recording["tip_angle_deg"], abs=0.1)
    for name, values in made.measured.items():
        assert np.array_equal(recording[f"measured_{name}"], values)
    assert recording.parameters["controller"] == "feedforward"


def test_only_a_needle_that_goes_in_has_a_path():
    assert "path_x_mm" not in record_closed_loop(controlled(0.0)).table
    going = controlled(5.0)
    recording = record_closed_loop(going)
    path = np.stack([recording[f"path_{axis}_mm"] for axis in "xyz"], axis=1)
    rolls = np.radians(going.run.tip_deg)
    assert path == pytest.approx(path_mm(going.run.inputs.inserted_mm, rolls))
