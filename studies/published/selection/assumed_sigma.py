"""How conclusions depend on the standard deviation that is assumed for Tables IV and V."""

import math
from collections.abc import Sequence

import numpy as np
from scipy.optimize import brentq
from scipy.stats import chi2

from studies.published.criteria import LARGEST_SIGMA, LEAST_P_VALUE, SCANNED_SIGMAS
from studies.published.experiments.figures import plastisol
from studies.published.fitting.fit import FigureFit, chi_square_p_value
from studies.published.selection.twist_constraint import contradiction


def chi_square_at(fit: FigureFit, relative_sigma: float) -> float:
    """Chi-square of a fit of plastisol, not fitted again, with another sigma of Tables IV and V."""
    new = np.array([f.sigma for f in plastisol(relative_sigma)])
    old = np.array([f.sigma for f in fit.figures])
    return float(np.square(fit.residual * old / new).sum())


def sigma_needed(fit: FigureFit) -> float:
    """Smallest relative sigma of Tables IV and V at which a fit is consistent; infinite if none is.

    The fit is not repeated, so for a fitted hypothesis this is an upper bound.
    """
    limit = float(chi2.isf(LEAST_P_VALUE, fit.degrees_of_freedom))

    def excess(log_sigma: float) -> float:
        return chi_square_at(fit, math.exp(log_sigma)) - limit

    low, high = math.log(1e-4), math.log(LARGEST_SIGMA)
    if excess(high) > 0:
        return math.inf
    return math.exp(float(brentq(excess, low, high))) if excess(low) > 0 else 0.0


def consistent_sets(fits: Sequence[FigureFit]) -> dict[float, int]:
    """Least number of sets of mechanisms that are consistent, by the sigma of Tables IV and V."""
    return {
        sigma: len({f.hypothesis.names for f in fits if _is_consistent_at(f, sigma)})
        for sigma in SCANNED_SIGMAS
    }


def _is_consistent_at(fit: FigureFit, relative_sigma: float) -> bool:
    p_value = chi_square_p_value(chi_square_at(fit, relative_sigma), fit.degrees_of_freedom)
    return p_value >= LEAST_P_VALUE and not contradiction(fit)
