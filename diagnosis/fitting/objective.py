"""Residuals of a log as a function of the fit's vector, and their slopes.

The nuisance moves by a few per cent at the most: its slopes are taken again only where the
effects have moved far.
"""

import numpy as np
from numpy.typing import NDArray

from diagnosis.fitting.parameterization import Parameterization
from diagnosis.fitting.problem import FitProblem
from sim.simulation import SimulationFailed

Array = NDArray[np.float64]

_FAR = 0.1  # of the effects' entries, after which the slopes of the nuisance are taken again


class Objective:
    """For `mujoco.minimize`: callable, with a Jacobian by finite differences.

    Attributes:
      difference: that slopes are taken over.
      slopes: the last Jacobian that was taken, (N, n).
    """

    def __init__(
        self, problem: FitProblem, parameterization: Parameterization, difference: float = 1e-3
    ) -> None:
        self.problem, self.parameterization = problem, parameterization
        self.difference = difference
        self.low, self.high = parameterization.bounds()
        self.slopes: Array | None = None
        self._fresh_at: Array | None = None
        self._rows: int | None = None

    def __call__(self, x: Array) -> Array:
        """(n, M) or (n,) to residuals with the prior, (N, M) or (N,)."""
        columns = x.reshape(x.shape[0], -1)
        rigs = [self.parameterization.rig(x) for x in columns.T]
        try:
            trials = self.problem.residuals(rigs)
        except SimulationFailed:
            if self._rows is None or columns.shape[1] > 1:
                raise
            return np.full((self._rows, *x.shape[1:]), np.nan)  # a step too far: it is taken back
        rows = [
            np.concatenate([*(t[i] for t in trials), self.parameterization.weights * columns[:, i]])
            for i in range(columns.shape[1])
        ]
        self._rows = rows[0].size
        return np.stack(rows, axis=-1).reshape(-1, *x.shape[1:])

    def jacobian(self, x: Array, at_x: Array) -> Array:
        """By differences away from the bounds, (N, n)."""
        flat = x.ravel()
        steps = np.where(flat + self.difference > self.high, -1.0, 1.0) * self.difference
        taken = np.arange(self.parameterization.free)
        slopes = np.zeros((at_x.size, flat.size)) if self.slopes is None else np.array(self.slopes)
        if self._fresh_at is None or np.abs(flat - self._fresh_at)[taken].max(initial=0.0) > _FAR:
            taken, self._fresh_at = np.arange(flat.size), flat
        if taken.size:
            moved = self(flat[:, None] + np.diag(steps)[:, taken])
            slopes[:, taken] = (moved - at_x.reshape(-1, 1)) / steps[taken]
        self.slopes = slopes
        return slopes
