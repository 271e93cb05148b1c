"""The torque-driven modal needle as a state space: equations (19)-(23).

States are the modal amplitudes q_k of (12), the input is the base torque u, N mm. By
the series the angles are

    base = q_0 / 2 + sum q_k  (+ u f / kappa, over a free length f)
    tip  = q_0 / 2 + sum (-1)^k q_k

`paper_tip` is the paper's (23c), in which mode 0 counts fully instead of by half.
"""

import control
import numpy as np
from numpy.typing import NDArray

from models.modes import InsertedNeedle

OUTPUTS = ("base_rad", "tip_rad", "paper_tip_rad")


def modal_system(needle: InsertedNeedle, *, modes: int) -> control.StateSpace:
    """Inertialess modal model with `modes` states, mode 0 first: (22), (23).

    Args:
      needle: its `drive` is ignored: the input is a torque.
      modes: number of states.

    Returns:
      Input `torque_n_mm`; outputs as in `OUTPUTS`, rad.
    """
    k = np.arange(modes)
    kappa, beta, length = (
        needle.needle.rigidity_n_mm2,
        needle.damping_n_mm_s_per_mm,
        needle.inserted_mm,
    )
    a = np.diag(-kappa / beta * (k * np.pi / length) ** 2)
    b = np.full((modes, 1), 2 / (length * beta))
    half = np.where(k == 0, 0.5, 1.0)
    sign = (-1.0) ** k
    c = np.vstack([half, half * sign, sign])
    d = np.array([[needle.free_mm / kappa], [0.0], [0.0]])
    return control.ss(
        a, b, c, d, inputs=["torque_n_mm"], outputs=list(OUTPUTS), states=[f"q_{i}" for i in k]
    )


def full_modal_system(needle: InsertedNeedle, *, modes: int) -> control.StateSpace:
    """The modal model with inertia, (20): states are the amplitudes, then their rates."""
    slow = modal_system(needle, modes=modes)
    eta, beta = needle.needle.rotary_inertia_kg_m, needle.damping_n_mm_s_per_mm
    zero, one = np.zeros((modes, modes)), np.eye(modes)
    a = np.block([[zero, one], [beta / eta * slow.A, -beta / eta * one]])
    b = np.vstack([np.zeros((modes, 1)), beta / eta * slow.B])
    c = np.hstack([slow.C, np.zeros_like(slow.C)])
    return control.ss(a, b, c, slow.D, inputs=["torque_n_mm"], outputs=list(OUTPUTS))


def hankel_ratios(
    needle: InsertedNeedle, *, modes: int, leak_rad_s: float | None = None
) -> NDArray[np.float64]:
    """Hankel singular values from torque to tip, largest first, relative to the largest.

    Mode 0 integrates, so its Hankel value is infinite: it is left out, or gets a slow pole at
    `leak_rad_s`. The paper states neither, and its values follow from neither.
    """
    system = modal_system(needle, modes=modes)
    a, b, c = np.array(system.A), np.array(system.B), np.array(system.C)[1:2]
    if leak_rad_s is None:
        a, b, c = a[1:, 1:], b[1:], c[:, 1:]
    else:
        a[0, 0] = -leak_rad_s
    values = np.asarray(control.hankel_singular_values(control.ss(a, b, c, 0)))
    ratios: NDArray[np.float64] = np.sort(values)[::-1] / values.max()
    return ratios
