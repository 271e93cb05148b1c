"""The shaft's twist in modes, while its inserted length changes.

From the tip, s = 0, to the entry, s = l, with the base torque u acting there:

    theta(s, t) = q_0 / 2 + sum_k p_k cos(k pi s / l),      p_k = (-1)^k q_k of (12)
    dp_k/dt = -(kappa / beta) (k pi / l)^2 p_k + (-1)^k 2 u / (l beta)
              - (dl/dt) / l  sum_j g_kj p_j                  (the shapes stretch with l)
    g_kj = (2 / l) int (j pi s / l) sin(j pi s / l) cos(k pi s / l) ds

The last line corrects the amplitudes while the needle is inserted: each point of the shaft
keeps its angle although the mode shapes change. Base and tip are

    base = u f / kappa + q_0 / 2 + sum (-1)^k p_k,    tip = q_0 / 2 + sum p_k
    tip = base - u f / kappa + 2 sum over odd k of p_k

so that even modes do not contribute to the lag. The odd modes that truncation drops are
replaced by their static response to u, `tail`.
"""

import numpy as np
from numpy.typing import NDArray

from models.errors import InvalidValue
from models.needle import Needle

Array = NDArray[np.float64]


class Twist:
    """Constants of the modal model of one needle, modes 1 .. order - 1.

    Args:
      needle: the shaft.
      order: number of modes including mode 0, as the paper counts; 4 by default.

    Raises:
      InvalidValue: order below 2.
    """

    def __init__(self, needle: Needle, order: int = 4) -> None:
        if order < 2:
            raise InvalidValue("order", order, "at least 2: mode 0 alone cannot twist")
        self.kappa = needle.rigidity_n_mm2
        self.k = np.arange(1, order)
        self.squares = (self.k * np.pi) ** 2
        self.sign = np.where(self.k % 2 == 1, -1.0, 1.0)
        self.odd = self.k % 2 == 1
        self.lag_weights = np.where(self.odd, 2.0, 0.0)  # of the modes in tip - base
        self.stretch = _stretch(self.k.astype(float))
        # sum over odd k of 1/k^2 is pi^2 / 8: what the kept modes leave of it.
        self.tail = np.pi**2 / 8 - float((1.0 / self.k[self.odd] ** 2).sum())

    def poles(self, inserted_mm: float, damping: float) -> Array:
        """Poles of modes 1 .. order - 1, rad/s."""
        return np.asarray(-self.kappa / (damping * inserted_mm**2) * self.squares, np.float64)

    def tail_rad(self, torque_n_mm: float, inserted_mm: float) -> float:
        """Static lag of the odd modes that are left out, rad (negative of the lag)."""
        return -4 * inserted_mm * torque_n_mm * self.tail / (self.kappa * np.pi**2)


def _stretch(k: Array) -> Array:
    """g_kj of the module's docstring, (modes, modes)."""
    row, column = np.asarray(k[:, None]), np.asarray(k[None, :])
    with np.errstate(divide="ignore", invalid="ignore"):
        apart: Array = 2 * column**2 / (row**2 - column**2) * (-1.0) ** (row + column)
    return np.asarray(np.where(row == column, -0.5, apart), np.float64)
