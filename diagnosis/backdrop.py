"""A fit as the backdrop of an effect that it lacks: what its own slopes would take back."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from diagnosis.fit import Fit

Array = NDArray[np.float64]


class Backdrop:
    """Residuals less all that the parameters of a fit could explain of them.

    Attributes:
      left: of the fit's own residual with its prior.
    """

    def __init__(self, base: Fit, name: str) -> None:
        """Of a fit; nuisance of the name of the effect is its own, not the fit's."""
        self._kept = np.array([owner != name for owner in base.coordinates.owners], bool)
        self._prior = base.coordinates.weights * base.x
        self._residual = np.concatenate([*base.by_trial, self._prior])
        slopes = np.vstack([*base.jacobian, np.diag(base.coordinates.weights)])[:, self._kept]
        self._basis = np.linalg.qr(slopes)[0]
        self.left = self._beside(self._residual)

    def moved(self, by_trial: Sequence[Array]) -> Array:
        """What residuals, one array a trial, differ by from those of the fit."""
        moved = np.concatenate([*by_trial, np.where(self._kept, self._prior, 0.0)])
        return self._beside(moved - self._residual)

    def _beside(self, residual: Array) -> Array:
        return np.asarray(residual - self._basis @ (self._basis.T @ residual))
