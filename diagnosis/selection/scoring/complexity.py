"""Complexity penalty of an explanation: what it has to take off the cost to be worth its freedom.

The evidence of a fit is its likelihood times the share of its freedom that the data leave (Laplace):

    penalty = log det(prior + known) / det(prior)

`known` is what the readings tell of the reported parameters, while all others that are fitted are open.
`prior` is what one reading tells of them (the unit information of BIC; Kass & Wasserman 1995), and that
they are within their bounds. What the data determine well costs log(samples), as in BIC; a parameter
that they do not determine costs nothing, since it explains nothing.

An effect that contains a simpler one costs log(samples) for every parameter: where it looks like that,
the data never determine its shape. Whether a typical form of it may be there is asked afterwards
(equivalence/weak_forms.py).

And what the choice among many costs: nothing, one of all effects, one of all pairs and one of all sets
of three are equally likely before the data; one of hundreds of pairs fits by chance more often than one
of thirty effects.
"""

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from diagnosis.effects import FITTED
from diagnosis.effects.effect import Parameter
from diagnosis.fitting.fit import Fit
from diagnosis.fitting.held_out.cross_validation import information

Array = NDArray[np.float64]

_UNIFORM = 12.0  # over the variance of a uniform distribution of width 1


def complexity_penalty(fit: Fit) -> float:
    """Penalty of a fitted set of effects, in cost."""
    return _freedom(fit) + choice_penalty(fit.names)


def most_penalty(names: Sequence[str], samples: int) -> float:
    """Penalty of a set of effects of which so many residuals tell every parameter: the largest."""
    told = sum(len(FITTED[n].reported) for n in names)
    return told * math.log(1.0 + samples) + choice_penalty(names)


def choice_penalty(names: Sequence[str]) -> float:
    """What the choice of this set among all of as many effects costs: the least penalty."""
    return 2.0 * math.log(math.comb(len(FITTED), len(names)))


def _freedom(fit: Fit) -> float:
    effects = fit.parameterization.effects
    each = [(effect, p) for effect in effects for p in effect.parameters]
    parameters = [p for _, p in each]
    richer = sum(p.reported and bool(effect.contains) for effect, p in each)
    told = np.array([i for i, (e, p) in enumerate(each) if p.reported and not e.contains], int)
    return richer * math.log(1.0 + fit.samples) + _open_freedom(fit, parameters, told)


def _open_freedom(fit: Fit, parameters: Sequence[Parameter], told: NDArray[np.int_]) -> float:
    """Of these entries of the fit's vector, each as far as the data determine it."""
    if not told.size:
        return 0.0
    all_known = information(fit)
    width = np.array([parameters[i].to_fit(parameters[i].high) for i in told])
    width -= [parameters[i].to_fit(parameters[i].low) for i in told]
    prior = np.diag(_UNIFORM / width**2) + all_known[np.ix_(told, told)] / max(fit.samples, 1)
    return _log_det(prior + _known_alone(all_known, told)) - _log_det(prior)


def _known_alone(known: Array, told: NDArray[np.int_]) -> Array:
    """Information on some parameters with all others open: their Schur complement."""
    others = np.setdiff1d(np.arange(known.shape[0]), told)
    beside = known[np.ix_(told, others)]
    return np.asarray(
        known[np.ix_(told, told)] - beside @ np.linalg.pinv(known[np.ix_(others, others)]) @ beside.T
    )


def _log_det(matrix: Array) -> float:
    return float(np.linalg.slogdet(matrix)[1])
