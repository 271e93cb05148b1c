"""The standard deviation of a curve's prior, estimated from the fit itself.

With n coordinates c of standard deviation tau a priori, and covariance C after the fit,

    well determined = n - trace(C) / tau^2,    tau^2 = c'c / well determined

(MacKay 1992, "Bayesian interpolation", equations 4.8 and 4.9). A residual above the noise counts as
noise.
"""

import math

import numpy as np
from numpy.typing import NDArray

from diagnosis.fitting.fit import Fit
from diagnosis.fitting.held_out.cross_validation import information
from diagnosis.freeform.family import KINDS, Family, kind_of

Array = NDArray[np.float64]

LEAST, MOST = 0.01, 20.0


def free_covariance(fit: Fit, *, without: int | None = None) -> Array:
    """Covariance of the vector of a fit, (n, n), with the whole residual taken for noise.

    Args:
      without: index of a trial that is left out; None: none.
    """
    weights = np.diag(fit.parameterization.weights**2)
    data = information(fit, without=without) - weights
    return np.asarray(np.linalg.pinv(data / max(1.0, fit.gap**2) + weights, hermitian=True))


def well_determined(family: Family, fit: Fit) -> float:
    """Effective number of parameters of a family that the data determine."""
    entries = _entries(family, fit)
    spread = np.diag(free_covariance(fit))[entries]
    weights = fit.parameterization.weights[entries]
    return float(np.sum(1.0 - np.minimum(spread * weights**2, 1.0)))


def with_estimated_prior(family: Family, fit: Fit) -> Family:
    """The family with priors estimated from the fit, for each part of its curve."""
    kinds = np.array([kind_of(p) for p in family.effect.parameters])
    entries = _entries(family, fit)
    spread = np.diag(free_covariance(fit))
    return family.with_prior({k: _strength(fit, spread, entries[kinds == k]) for k in KINDS})


def _strength(fit: Fit, spread: Array, entries: NDArray[np.int_]) -> float:
    """Estimated standard deviation of the prior on some coordinates."""
    if entries.size == 0:
        return 1.0
    sigma = 1.0 / fit.parameterization.weights[entries]
    known = max(entries.size - float(np.sum(spread[entries] / sigma**2)), 0.1)
    return float(np.clip(math.sqrt(float(fit.x[entries] @ fit.x[entries]) / known), LEAST, MOST))


def _entries(family: Family, fit: Fit) -> NDArray[np.int_]:
    return np.flatnonzero([owner == family.name for owner in fit.parameterization.owners])
