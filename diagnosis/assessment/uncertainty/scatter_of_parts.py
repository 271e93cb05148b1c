"""How far parameters are known: by the noise, or, if that is more, by how much parts of a log disagree.

What a model lacks is no noise, and noise may be slower than its estimate says: either pulls a parameter
up in one part of a log and down in another. Each part b, a quarter of a trial or less, pulls by
g_b = J_b' r_b, and by what the g_b scatter about their mean, of B parts in all, the parameters are
uncertain by

    C = H^-1 (B / (B - 1) sum over b of g_b g_b') H^-1,    H = J' J + prior

which is the covariance of least squares for errors that are correlated within parts ("sandwich"; White
1980, for clusters Liang and Zeger 1986). Of few parts the scatter is uncertain itself: with B - 1
degrees of freedom an interval is wider by t / z. What pulls in the same way everywhere does not show:
such intervals hold for the model as it is.
"""

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.stats import norm, t

from diagnosis.criteria.assessment import INTERVAL_Z
from diagnosis.fitting.fit import Fit
from diagnosis.fitting.noise_reestimation import by_trial_and_sensor
from diagnosis.fitting.problem import FitProblem

Array = NDArray[np.float64]

PARTS_OF_A_TRIAL = 4
PARTS = 16  # of a log, at least: of fewer the scatter says little


def covariance_by_parts(problem: FitProblem, fit: Fit, inverse: Array, left: float) -> Array:
    """Covariance of the vector of a fit, (n, n), in the units of the fit.

    Parameters are correlated as in the model, each with the larger of two variances.

    Args:
      inverse: of the information of the fit, (n, n).
      left: factor by which the residual exceeds the noise, of an incomplete model.
    """
    plain = left**2 * inverse
    own = np.diag(inverse @ _scatter_of(_pulls(problem, fit)) @ inverse)
    known = np.diag(plain)
    more = np.sqrt(np.divide(own, known, out=np.ones_like(own), where=known > 0.0).clip(min=1.0))
    return np.asarray(plain * np.outer(more, more))


def _pulls(problem: FitProblem, fit: Fit) -> Array:
    """g of each part, (B, n)."""
    left = by_trial_and_sensor(problem, fit.by_trial)
    slopes = by_trial_and_sensor(problem, fit.jacobian)
    read = [(one, other) for one, other in zip(left, slopes, strict=True) if one]
    parts = max(PARTS_OF_A_TRIAL, math.ceil(PARTS / max(len(read), 1)))
    return np.concatenate(
        [_pulls_of_trial([r for _, _, r in a], [j for _, _, j in b], parts) for a, b in read]
    )


def _pulls_of_trial(left: Sequence[Array], slopes: Sequence[Array], parts: int) -> Array:
    """g of the parts of a trial, all sensors together, (parts, n)."""
    each = zip(left, slopes, strict=True)
    return np.asarray(sum(_pulls_of_sensor(*own, parts) for own in each))


def _pulls_of_sensor(left: Array, slopes: Array, parts: int) -> Array:
    cut = (np.array_split(rows, parts) for rows in (left, slopes))
    return np.array([j.T @ r for r, j in zip(*cut, strict=True)])


def _scatter_of(pulls: Array) -> Array:
    """Covariance of the sum of pulls, (n, n), for an interval of the normal distribution."""
    count = len(pulls)
    about = pulls - pulls.mean(axis=0)
    wider = float(t.ppf(norm.cdf(INTERVAL_Z), count - 1)) / INTERVAL_Z
    return np.asarray(wider**2 * count / (count - 1) * about.T @ about)
