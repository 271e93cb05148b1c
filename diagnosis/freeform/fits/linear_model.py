"""A fit as a linear model: what its own coordinates cannot take off.

With J the slopes of the fit and r its residual, both with the prior, and G = J'J, changes D of the
readings leave, once the fit has moved as well as it can,

    D'D - (J'D)' G^-1 (J'D),    D'l,    of the residual l = r - J G^-1 J'r.

By the factor of G, whose columns are scaled to one: a tenth of the time of a QR factorisation of J, and
precise enough to tell what is worth a fit.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import cho_solve, cholesky, solve_triangular

from diagnosis.fitting.fit import Fit

Array = NDArray[np.float64]

_RIDGE = 1e-10  # of the square of a column: of two that are alike, G has no inverse


@dataclass(frozen=True, kw_only=True, eq=False)
class LinearModel:
    """What a fit says about small changes.

    Attributes:
      slopes: scaled, with the prior, (N + n, n).
      root: lower factor of the products of the slopes, (n, n).
      left: what is left of the residual, with the prior, (N + n,).
    """

    slopes: Array
    root: Array
    left: Array

    @cached_property
    def cost(self) -> float:
        """Cost that the fit could come to by itself."""
        return float(self.left @ self.left)

    def beyond(self, changes: Array) -> tuple[Array, Array]:
        """Of changes of the residuals, (N, k), what the slopes do not reproduce.

        Returns:
          their products, (k, k), and those with what is left of the residual, (k,).
        """
        rows = len(changes)  # those of the prior, which follow, do not change
        within = solve_triangular(self.root, self.slopes[:rows].T @ changes, lower=True)
        squares = changes.T @ changes - within.T @ within
        return squares, changes.T @ self.left[:rows]


def linear_model(fit: Fit) -> LinearModel:
    """The linear model of a fit."""
    slopes, residual = fit.slopes, fit.residual
    sizes = np.sqrt(np.sum(slopes**2, axis=0))
    slopes = slopes / np.where(sizes > 0.0, sizes, 1.0)
    products = slopes.T @ slopes + _RIDGE * np.eye(sizes.size)
    root = np.asarray(cholesky(products, lower=True))
    moved = cho_solve((root, True), slopes.T @ residual)
    return LinearModel(slopes=slopes, root=root, left=residual - slopes @ moved)
