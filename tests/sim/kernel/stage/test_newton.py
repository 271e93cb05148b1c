"""Newton's method on one stage: balanced where it stops, in one iteration where that is exact.

`sim.kernel.stage.newton` in the interpreter: the same source, nothing to compile.
"""

import numpy as np
import pytest

from models.needle import NITINOL
from models.tissue import Tissue
from sim.discretisation import Discretisation
from sim.needles.setup import Setup

VISCOUS = Tissue.uniform(viscous_n_mm_s_per_mm=0.02)
DRY = Tissue.uniform(viscous_n_mm_s_per_mm=0.002, kinetic_n_mm_per_mm=0.02)
STRIBECK = Tissue.uniform(
    viscous_n_mm_s_per_mm=0.002,
    kinetic_n_mm_per_mm=0.005,
    static_n_mm_per_mm=0.01,
    stribeck_rad_s=0.1,
)
WEAKENING = Tissue.uniform(
    viscous_n_mm_s_per_mm=1e-4,
    kinetic_n_mm_per_mm=0.001,
    static_n_mm_per_mm=0.03,
    stribeck_rad_s=0.1,
)
SHARED = Tissue.uniform(viscous_n_mm_s_per_mm=0.002, shared_n_mm_per_mm=0.02)
YIELDING = Tissue.uniform(
    viscous_n_mm_s_per_mm=0.02, stiffness_n_mm_per_rad_per_mm=0.02, time_constant_s=1.0
)


def setup(tissue):
    cut = Discretisation(elements=8, step_s=0.01)
    return Setup(needle=NITINOL, tissue=tissue, discretisation=cut, free_mm=20, inserted_mm=80)


def solve(interpreted, stage, *, nonlinear, drive=0.5):
    return interpreted.newton.newton(
        stage.head, stage.law, stage.w, stage.frame, drive, 0.0, nonlinear, False
    )


def out_of_balance(interpreted, stage, drive=0.5):
    """The residual over the stiffness, as a rate, rad/s: largest of all nodes."""
    w = stage.w
    interpreted.assemble.add_linear(w, stage.frame.g, True)
    torque, slope = interpreted.chuck.drive_torque(w, stage.frame, drive)
    w.rhs[0] += torque
    w.diagonal[0] += slope
    interpreted.newton._add_other_rows(stage.law, w, stage.frame, 0.0)
    return np.abs(w.rhs / w.diagonal).max()


def test_a_viscous_stage_takes_one_iteration(interpreted, at_stage):
    stage = at_stage(setup(VISCOUS))
    before = out_of_balance(interpreted, stage)
    converged, iterations, *_ = solve(interpreted, stage, nonlinear=False)
    assert (converged, iterations) == (True, 1)
    assert out_of_balance(interpreted, stage) < 1e-9 * before


@pytest.mark.parametrize(
    "tissue", [DRY, STRIBECK, SHARED, YIELDING], ids=["dry", "stribeck", "shared", "yielding"]
)
@pytest.mark.parametrize("drive", [-0.5, 0.1, 0.5])
def test_a_nonlinear_stage_ends_in_balance(interpreted, at_stage, tissue, drive):
    stage = at_stage(setup(tissue), speed_m_s=1e-3)
    converged, iterations, *_ = solve(interpreted, stage, nonlinear=True, drive=drive)
    assert converged
    assert 1 <= iterations < 40
    assert out_of_balance(interpreted, stage, drive) < 1e-9


@pytest.mark.parametrize("drive", [0.02, 0.1, 0.3])
def test_a_needle_that_snaps_ends_in_balance(interpreted, at_stage, drive, monkeypatch):
    """Friction that falls with the rate faster than torsion and tissue resist: no convex potential."""
    stage = at_stage(setup(WEAKENING), turn_deg=0.0)
    stage.w.start[:, :, :, interpreted.memory_map.Z_DRY] = stage.frame.yield_angle  # it slides
    convex, factorise = [], interpreted.newton.factorise
    monkeypatch.setattr(
        interpreted.newton, "factorise", lambda *a: convex.append(factorise(*a)) or convex[-1]
    )
    converged, iterations, *_ = solve(interpreted, stage, nonlinear=True, drive=drive)
    assert converged
    assert iterations < 80
    assert not all(convex)
    assert convex[-1]
    assert out_of_balance(interpreted, stage, drive) < 1e-9


def test_one_iteration_would_not_balance_dry_friction(interpreted, at_stage):
    """Negative control: dry friction is not linear."""
    stage = at_stage(setup(DRY))
    solve(interpreted, stage, nonlinear=False)  # stops after the first
    assert out_of_balance(interpreted, stage) > 1e-6


def test_an_infinite_step_is_reported_and_not_iterated_on(interpreted, at_stage):
    stage = at_stage(setup(DRY))
    with np.errstate(invalid="ignore"):
        converged, iterations, *_ = solve(interpreted, stage, nonlinear=True, drive=float("inf"))
    assert (converged, iterations) == (False, 1)


@pytest.mark.parametrize(("tissue", "nonlinear"), [(VISCOUS, False), (DRY, True)])
def test_a_drive_that_is_no_number_does_not_count_as_converged(interpreted, at_stage, tissue, nonlinear):
    converged, *_ = solve(interpreted, at_stage(setup(tissue)), nonlinear=nonlinear, drive=np.nan)
    assert not converged
