"""The lumped needle as ordinary differential equations, for general solvers.

Cells of length a, their angles at their centres, half a cell between the base and
the first. Without inertia the torque f per mm that the shaft puts on a cell's tissue,
f = spring (differences of the angles), spring = kappa / a^2, sets its rate:

    viscous         theta' = f / beta
    Kelvin-Voigt    phi' = (f / k - phi) / tau,   theta' = phi' + f / beta
    dry             theta' = (f - level clamp(z) / z_y) / beta,
                    z' = theta' - (z - clamp(z)) / relaxation

z is the presliding angle, clamp(z) keeps it within z_y. Letting z overrun z_y by
rate times relaxation makes the right-hand side continuous; at a switch instead, LSODA
loses its way or crawls. States are interleaved, (theta_0, phi_0, theta_1, ...), so that
Jacobians are banded; they are given as LSODA packs them: row i - j + above, column j.

Everything here is plain NumPy, and numba compiles it as it stands.
"""

import numpy as np
from numba.extending import register_jitable
from numpy.typing import NDArray

from benchmarks.tissues import TURN_RAD, TURN_S

Array = NDArray[np.float64]


@register_jitable
def line_torque(t: float, theta: Array, spring: float) -> Array:
    """f, N mm / mm."""
    carried = np.zeros(theta.size + 1)
    carried[0] = 2.0 * (TURN_RAD * min(t / TURN_S, 1.0) - theta[0])
    carried[1:-1] = theta[:-1] - theta[1:]
    return spring * (carried[:-1] - carried[1:])


@register_jitable
def own_slope(cells: int, spring: float) -> Array:
    """df_i / dtheta_i."""
    slope = np.full(cells, -2.0 * spring)
    slope[0], slope[-1] = -3.0 * spring, -spring
    return slope


def smooth_rate(t: float, y: Array, spring: float, damping: float) -> Array:
    """Viscous tissue; y is theta."""
    return line_torque(t, y, spring) / damping


def smooth_jacobian(t: float, y: Array, spring: float, damping: float) -> Array:
    """Bands: 1 above, 1 below."""
    packed = np.full((3, y.size), spring / damping)
    packed[1] = own_slope(y.size, spring) / damping
    return packed


def yielding_rate(
    t: float, y: Array, spring: float, damping: float, stiffness: float, time_constant: float
) -> Array:
    """Kelvin-Voigt tissue in series; y is theta, phi, interleaved."""
    torque = line_torque(t, y[::2], spring)
    rate = np.empty(y.size)
    rate[1::2] = (torque / stiffness - y[1::2]) / time_constant
    rate[::2] = rate[1::2] + torque / damping
    return rate


def yielding_jacobian(
    t: float, y: Array, spring: float, damping: float, stiffness: float, time_constant: float
) -> Array:
    """Bands: 2 above, 3 below."""
    ones = np.ones(y.size // 2)
    creep, relaxed = ones / (stiffness * time_constant), -ones / time_constant
    return _interleaved(spring, creep + 1.0 / damping, relaxed, creep, relaxed)


def dry_rate(
    t: float, y: Array, spring: float, damping: float, level: float, limit: float, relaxation: float
) -> Array:
    """Dry friction over viscous; y is theta, z, interleaved."""
    held = np.clip(y[1::2], -limit, limit)
    rate = np.empty(y.size)
    rate[::2] = (line_torque(t, y[::2], spring) - level / limit * held) / damping
    rate[1::2] = rate[::2] - (y[1::2] - held) / relaxation
    return rate


def dry_jacobian(
    t: float, y: Array, spring: float, damping: float, level: float, limit: float, relaxation: float
) -> Array:
    """Bands: 2 above, 3 below."""
    sticks = (np.abs(y[1::2]) < limit) * 1.0
    moved = np.ones(y.size // 2) / damping
    held = -level / limit / damping * sticks
    return _interleaved(spring, moved, held, moved, held - (1.0 - sticks) / relaxation)


@register_jitable
def _interleaved(spring: float, by_f: Array, by_s: Array, s_by_f: Array, s_by_s: Array) -> Array:
    """Packed Jacobian of theta' and s' from their slopes against f and s."""
    own = own_slope(by_f.size, spring)
    packed = np.zeros((6, 2 * by_f.size))
    packed[2, ::2], packed[1, 1::2] = by_f * own, by_s
    packed[3, ::2], packed[2, 1::2] = s_by_f * own, s_by_s
    packed[4, :-2:2], packed[0, 2::2] = by_f[1:] * spring, by_f[:-1] * spring
    packed[5, :-2:2], packed[1, 2::2] = s_by_f[1:] * spring, s_by_f[:-1] * spring
    return packed
