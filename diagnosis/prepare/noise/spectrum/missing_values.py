"""Values that were not read, drawn from what an autoregression says of them, given those that were.

The density of all values y of an autoregression is exp(-y' Q y / 2), with the banded

    Q[i, i + k] = sum over j of b_j b_(j + k) / s^2,    b = 1, -a_1, ..., -a_p

away from both ends. Given those that were read, the missing ones are normal, with the inverse covariance
Q of their rows and columns (Rue and Held 2005, Section 2.2),

    Q_mm (mean) = -Q_mr y_r,    y_m = mean + L^-T z,    Q_mm = L L',    z ~ N(0, 1)
"""

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import cho_solve_banded, cholesky_banded, solve_banded

from diagnosis.prepare.noise.autoregression import Autoregression

Array = NDArray[np.float64]


def completed(model: Autoregression, values: Array, rng: np.random.Generator) -> Array:
    """Values of variance 1 at every step, (N,), with those that are NaN drawn."""
    missing = np.flatnonzero(np.isnan(values))
    if not missing.size:
        return values
    weights = _precision(model)
    read = np.nan_to_num(values)
    pull = np.convolve(read, np.concatenate([weights[:0:-1], weights]), "same")[missing]
    root = cholesky_banded(_banded(missing, weights), lower=True)
    mean = cho_solve_banded((root, True), -pull)
    return _with(read, missing, mean + _scattered(root, rng))


def _precision(model: Autoregression) -> Array:
    """Q at lags of 0 to p, (p + 1,)."""
    b = np.concatenate([[1.0], -model.coefficients])
    return np.array([b[: b.size - k] @ b[k:] for k in range(b.size)]) / (1.0 - model.share)


def _banded(missing: NDArray[np.int_], weights: Array) -> Array:
    """Rows and columns of missing values, as the lower diagonals of a banded matrix."""
    found = np.zeros((min(weights.size, missing.size), missing.size))
    for k in range(len(found)):
        apart = missing[k:] - missing[: missing.size - k]
        near = apart < weights.size
        found[k, : missing.size - k][near] = weights[apart[near]]
    return found


def _scattered(root: Array, rng: np.random.Generator) -> Array:
    """L^-T z."""
    upper = np.zeros_like(root)
    for k, own in enumerate(root):
        upper[root.shape[0] - 1 - k, k:] = own[: own.size - k]
    white = np.asarray(rng.normal(size=root.shape[1]), float)
    return np.asarray(solve_banded((0, len(root) - 1), upper, white), float)


def _with(values: Array, at: NDArray[np.int_], drawn: Array) -> Array:
    found = values.copy()
    found[at] = drawn
    return found
