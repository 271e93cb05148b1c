"""The matrix of a stage is the derivative of its residual, term by term.

`sim.kernel.stage.assemble` in the interpreter: the same source, nothing to compile.
"""

import numpy as np
import pytest

from models.drive import Drive
from models.needle import NITINOL
from models.tissue import Tissue
from sim.discretisation import Discretisation, Mesh
from sim.needles.setup import Setup

TISSUES = {
    "viscous": Tissue.uniform(viscous_n_mm_s_per_mm=0.02),
    "power law": Tissue.uniform(viscous_n_mm_s_per_mm=0.02, exponent=0.6),
    "dry, sticking": Tissue.uniform(kinetic_n_mm_per_mm=0.01),
    "shared": Tissue.uniform(shared_n_mm_per_mm=0.01),
    "yielding": Tissue.uniform(
        viscous_n_mm_s_per_mm=0.02, stiffness_n_mm_per_rad_per_mm=0.02, time_constant_s=1.0
    ),
    "shaped": Tissue.uniform(
        viscous_n_mm_s_per_mm=0.02,
        kinetic_n_mm_per_mm=0.01,
        asymmetry=0.3,
        rate_curve=(3.0, 2.5, 2.0, 1.7, 1.4, 1.2, 1.0, 0.9, 0.8, 0.75, 0.7, 0.65),
        orientation_n_mm_per_mm=0.003,
        orientation_viscous_n_mm_s_per_mm=0.01,
        orientation_cycles=2.0,
    ),
    "keyed": Tissue.uniform(
        kinetic_n_mm_per_mm=0.01, orientation_dry_n_mm_per_mm=0.01, orientation_phase_deg=30.0
    ),
    "entry": Tissue.uniform(viscous_n_mm_s_per_mm=0.02, entry_friction_n_mm=0.1),
}
BENT = NITINOL.but(curvature_n_mm_per_mm=0.003, curvature_phase_deg=40, load_coefficient=0.3)


def setup(tissue, *, needle=NITINOL, mesh=Mesh.EULERIAN, drive=None):
    return Setup(
        needle=needle,
        tissue=tissue,
        drive=drive or Drive(),
        discretisation=Discretisation(elements=5, step_s=0.001, presliding_deg=5),
        mesh=mesh,
        free_mm=20,
        inserted_mm=40,
    )


def residual(interpreted, stage, omega, *, drive=0.2, tip_torque=1e-4):
    """Torques out of balance at rates, and the matrix (dense)."""
    w, assemble = stage.w, interpreted.assemble
    w.omega[:] = omega
    assemble.add_linear(w, stage.frame.g, True)
    torque, slope = interpreted.chuck.drive_torque(w, stage.frame, drive)
    w.rhs[0] += torque
    w.rhs[-1] -= tip_torque
    w.diagonal[0] += slope
    for r, row in enumerate(stage.law):
        if assemble.is_linear(row):
            beta = row[interpreted.memory_map.L_VISCOUS]
            assemble.add_viscous_advection(w, w.loads[r], beta, stage.frame)
        else:
            assemble.add_row(w, r, row, stage.frame, tip_torque)
    matrix = np.diag(w.diagonal) + np.diag(w.lower[1:], -1) + np.diag(w.upper[:-1], 1)
    return w.rhs.copy(), matrix


def derivative(interpreted, stage, omega, step=1e-6):
    columns = []
    for i in range(omega.size):
        away = step * np.eye(omega.size)[i]
        ahead, _ = residual(interpreted, stage, omega + away)
        behind, _ = residual(interpreted, stage, omega - away)
        columns.append((behind - ahead) / (2 * step))
    return np.array(columns).T


@pytest.mark.parametrize("mesh", Mesh)
@pytest.mark.parametrize("speed_m_s", [0.0, -2.5e-3])
@pytest.mark.parametrize("name", TISSUES)
def test_the_matrix_is_the_derivative_of_the_residual(interpreted, at_stage, name, speed_m_s, mesh):
    stage = at_stage(setup(TISSUES[name], needle=BENT, mesh=mesh), speed_m_s=speed_m_s)
    omega = stage.w.omega.copy()
    _, matrix = residual(interpreted, stage, omega)
    exact = derivative(interpreted, stage, omega)
    # The load-dependent level follows the twist, which the matrix leaves out on purpose: it is
    # below a part in a thousand of the shaft's stiffness.
    scale = np.abs(exact).max()
    assert np.abs(matrix - exact).max() < 1e-3 * scale
    assert np.abs(1.01 * matrix - exact).max() > 1e-3 * scale  # negative control


@pytest.mark.parametrize(
    ("name", "linear"), [("viscous", True), ("power law", False), ("shared", False)]
)
def test_only_viscous_friction_needs_no_iteration(interpreted, at_stage, name, linear):
    stage = at_stage(setup(TISSUES[name]))
    assert bool(interpreted.assemble.is_linear(stage.law[0])) is linear
