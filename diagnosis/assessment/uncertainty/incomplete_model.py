"""How far parameters of an incomplete model are known: by how much parts of the log disagree on them.

What a model lacks is no noise: it may pull a parameter up in one part of a log and down in another. Each
part b, a quarter of a trial, pulls by g_b = J_b' r_b, and by what the g_b scatter about their mean, of B
parts in all, the parameters are uncertain by

    C = H^-1 (B / (B - 1) sum over b of g_b g_b') H^-1,    H = J' J + prior

which is the covariance of least squares for errors that are correlated within parts ("sandwich"; White
1980, for clusters Liang and Zeger 1986). Of few parts the scatter is uncertain itself: with B - 1
degrees of freedom an interval is wider by t / z. What pulls in the same way everywhere does not show:
such intervals hold for the model as it is.
"""

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


def covariance_of_incomplete(problem: FitProblem, fit: Fit, inverse: Array, left: float) -> Array:
    """Covariance of the vector of a fit that leaves more than noise, (n, n), in the units of the fit.

    Parameters are correlated as in the model, each with the larger of two variances.

    Args:
      inverse: of the information of the fit, (n, n).
      left: factor by which the residual exceeds the noise.
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
    trials = zip(left, slopes, strict=True)
    return np.concatenate(
        [_pulls_of_trial([r for _, _, r in a], [j for _, _, j in b]) for a, b in trials if a]
    )


def _pulls_of_trial(left: Sequence[Array], slopes: Sequence[Array]) -> Array:
    """g of the parts of a trial, all sensors together, (parts, n)."""
    each = zip(left, slopes, strict=True)
    return np.asarray(sum(np.array([j.T @ r for r, j in _parts(*own)]) for own in each))


def _parts(left: Array, slopes: Array) -> list[tuple[Array, Array]]:
    cut = (np.array_split(rows, PARTS_OF_A_TRIAL) for rows in (left, slopes))
    return list(zip(*cut, strict=True))


def _scatter_of(pulls: Array) -> Array:
    """Covariance of the sum of pulls, (n, n), for an interval of the normal distribution."""
    count = len(pulls)
    about = pulls - pulls.mean(axis=0)
    wider = float(t.ppf(norm.cdf(INTERVAL_Z), count - 1)) / INTERVAL_Z
    return np.asarray(wider**2 * count / (count - 1) * about.T @ about)
