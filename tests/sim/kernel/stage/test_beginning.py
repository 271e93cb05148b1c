"""What the first stage of a step starts from, in the interpreter."""

import numpy as np
import pytest

from models.drive import Drive
from models.needle import NITINOL
from models.tissue import Tissue
from sim.discretisation import Discretisation
from sim.needles.setup import Setup

VISCOUS = Tissue.uniform(viscous_n_mm_s_per_mm=0.02)
DRY = VISCOUS.but(entry_friction_n_mm=0.01)
CUT = Discretisation(elements=4)


def _setup(needle=NITINOL, drive=None, tissue=VISCOUS):
    drive = drive or Drive()
    return Setup(
        needle=needle, drive=drive, tissue=tissue, discretisation=CUT, free_mm=20, inserted_mm=60
    )


@pytest.mark.parametrize(
    ("setup", "iterates"),
    [
        (_setup(), False),
        (_setup(tissue=DRY), True),
        (_setup(drive=Drive(backlash_deg=1.0)), True),
        (_setup(drive=Drive(grip_torque_n_mm=0.1)), True),
        (_setup(needle=NITINOL.but(yield_torque_n_mm=0.1, yield_stiffness_ratio=0.3)), True),
        (_setup(needle=NITINOL.but(creep_ratio=0.1, creep_time_s=1.0)), True),
        (_setup(needle=NITINOL.but(joint_play_deg=1.0, joint_from_tip_mm=10.0)), True),
        (_setup(needle=NITINOL.but(damping_time_s=0.1)), False),
    ],
)
def test_stages_are_iterated_if_and_only_if_something_is_not_linear(at_stage, setup, iterates):
    assert bool(at_stage(setup).nonlinear) is iterates


def test_angles_rates_and_inertias_are_those_of_the_start(at_stage):
    stage = at_stage(_setup())
    w, g = stage.w, stage.frame.g
    assert w.theta == pytest.approx(np.radians(10.0) * np.linspace(1.0, 0.4, w.theta.size))
    assert np.array_equal(w.rest, w.omega)
    assert w.inertia * g == pytest.approx(stage.shaft.inertia)
    assert np.array_equal(w.spring[: stage.shaft.spring.size], stage.shaft.spring)


def test_the_damping_of_all_nodes_is_that_of_the_inserted_shaft(at_stage):
    """Viscous rows: the sum of the matrix is the damping per mm times the inserted length."""
    w = at_stage(_setup()).w
    total = w.damp_lower.sum() + w.damp_diagonal.sum() + w.damp_upper.sum()
    assert total == pytest.approx(0.02 * 60 * 1e-3)  # N mm s to N m s


def test_shared_free_length_softens_its_elements_alone(interpreted, at_stage):
    """Torsion of a shaft is k / length."""
    stage, places = at_stage(_setup()), interpreted.memory_map
    head = stage.head.copy()
    head[places.H_STRETCHING], head[places.H_FREE_REF] = 2, 0.02
    inputs = interpreted.inputs.Inputs(0.04, 0.06, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, False)
    interpreted.beginning._set_springs(head, stage.shaft, stage.w, inputs)
    ratio = stage.w.spring[: stage.shaft.spring.size] / stage.shaft.spring
    assert ratio == pytest.approx(np.where(np.arange(ratio.size) < 2, 0.5, 1.0))


def test_the_memory_of_the_sites_is_where_the_stage_starts(at_stage):
    stage = at_stage(_setup(tissue=DRY))
    assert np.array_equal(stage.w.start, np.zeros_like(stage.w.start))
    assert np.array_equal(stage.w.end, stage.w.start)
