"""Modes that each relax at one rate, driven by a base angle.

A linear needle without inertia responds to a base angle u(t) with one term

    dc/dt = p c - a du/dt,        c = 0 at rest,

for every pole p, whatever resists the shaft: `a` is the share of a uniform turn that belongs to
the pole. The solution is exact if u is linear between samples.
"""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from models.errors import InvalidValue

Array = NDArray[np.float64]


def relaxing_modes(
    time_s: ArrayLike, drive_rad: ArrayLike, poles_rad_s: ArrayLike, shares: ArrayLike
) -> Array:
    """The terms c at every sample, rad, (N, poles).

    Args:
      time_s: increasing times, (N,).
      drive_rad: base angle at those times, rad, (N,).
      poles_rad_s: below 0, (poles,).
      shares: a of each pole, (poles,).

    Raises:
      InvalidValue: times do not increase.
    """
    t, u = np.asarray(time_s, float), np.asarray(drive_rad, float)
    if np.any(np.diff(t) <= 0):
        raise InvalidValue("time_s", t, "strictly increasing times")
    p, a = np.asarray(poles_rad_s, float), np.asarray(shares, float)
    c = np.zeros((t.size, p.size))
    for i in range(1, t.size):
        dt = t[i] - t[i - 1]
        rate = (u[i] - u[i - 1]) / dt
        c[i] = np.exp(p * dt) * c[i - 1] - a * rate * np.expm1(p * dt) / p
    return c
