"""What a fit tells of the rig's own constants, stiffness and damping.

The constants of some rigs are what rig.yaml says, to a tenth of a per cent; those of others scatter
about that. A priori both are equally likely: Gaussian, with a standard deviation of `EXACT` or of
`SCATTER`, the latter being the prior of every fit. An explanation with both constants at their nominal
values, where the data could have told otherwise, gains in score

    2 log((1 + B) / 2),    B = evidence of exact constants / evidence of scattered ones,

and one that needs them off gains nothing. The evidence is that of a Gaussian likelihood (Laplace).
"""

import math

import numpy as np
from numpy.typing import NDArray

from diagnosis.criteria.fitting import EXACT, SCATTER
from diagnosis.fitting.fit import Fit
from diagnosis.fitting.held_out.cross_validation import information

Array = NDArray[np.float64]


def open_scatter(fit: Fit) -> list[str]:
    """Constants that the fit adjusts without naming them."""
    return [e.name for e in fit.parameterization.nuisance if e.name in SCATTER]


def scatter_of(fit: Fit) -> tuple[Array, Array]:
    """By how much these are off, as fractions, (n,), and the covariance, (n, n)."""
    entries = [fit.parameterization.owners.index(name) for name in open_scatter(fit)]
    spread = np.asarray(np.linalg.pinv(information(fit)), float)
    return fit.x[entries], spread[np.ix_(entries, entries)]


def gain_of_exact_constants(fit: Fit) -> float:
    """What the fit gains in score; at the least -2 log 2."""
    scattered: Array = np.array([SCATTER[name] for name in open_scatter(fit)])
    if scattered.size == 0:
        return 0.0
    away, spread = scatter_of(fit)
    known = np.asarray(np.linalg.inv(spread), float)
    told, pull = known - np.diag(scattered**-2.0), known @ away
    exact = _log_evidence(told, pull, np.full_like(away, EXACT))
    odds = exact - _log_evidence(told, pull, scattered)
    return 2.0 * (float(np.logaddexp(0.0, odds)) - math.log(2.0))


def _log_evidence(told: Array, pull: Array, sigma: Array) -> float:
    """Of a likelihood exp(pull' x - x' told x / 2) under a prior, (n, n), (n,), (n,)."""
    known = told + np.diag(sigma**-2.0)
    _, log_size = np.linalg.slogdet(known * np.outer(sigma, sigma))
    return 0.5 * float(pull @ np.linalg.solve(known, pull) - log_size)
