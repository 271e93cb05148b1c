"""Noise of a sensor that grows with the rate of the base or with the torque.

A camera blurs what turns fast, a load cell in a gearbox shakes with its load: the standard deviation is

    sigma (1 + k x) / root mean square of (1 + k x),    x = |rate| or |torque| / the largest of the log

Differences of order 4 of what an explanation leaves, which share no sample, are independent and normal;
k is where they are likeliest. Whether noise grows is tested by the ratio of likelihoods. Something fast
that a model lacks grows as well, but is off in the same way from sample to sample: where the noise is
above its median, differences of order 1 have to tell the same as those of order 4.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import minimize_scalar
from scipy.special import binom

from diagnosis.criteria.faults import (
    GROWING_LEAST,
    GROWING_LOG_LIKELIHOOD,
    GROWING_MOST,
    GROWING_WHITE,
)
from diagnosis.criteria.prepare import LEAST_DIFFERENCES
from diagnosis.log.white_noise import white_noise
from diagnosis.prepare.prepared_log import PreparedLog, PreparedTrial

Array = NDArray[np.float64]
GrowsWith = Literal["rate", "torque"]

_ORDER = 4
_OUTLIER_SIGMA = 5.0
_MEDIAN = 0.6745  # of the sizes of normal values, in sigma


@dataclass(frozen=True, kw_only=True)
class GrowingNoise:
    """How the noise of a sensor grows.

    Attributes:
      grows_with: the rate of the base, deg/s, or the torque, N mm.
      growth_per_unit: by how much of the noise at 0 it grows with each of these.
      factor: noise at the largest of the log / noise at 0.
      rms_factor: root mean square over the samples of the log of noise / noise at 0.
      noise_ratio: root mean square of the noise / what it was taken for.
    """

    grows_with: GrowsWith
    growth_per_unit: float
    factor: float
    rms_factor: float
    noise_ratio: float = 1.0

    def sizes(self, trial: PreparedTrial) -> Array:
        """Noise at every sample / its root mean square, (N,)."""
        grown = 1.0 + self.growth_per_unit * _variable(self.grows_with, trial)
        return np.asarray(grown / self.rms_factor)

    @property
    def in_words(self) -> str:
        """With what it grows, and how much."""
        of = {"rate": "the rate of the base", "torque": "the torque"}[self.grows_with]
        return f"grows with {of}, to {self.factor:.1f} times that at rest"


def growing_noise(log: PreparedLog, left: Sequence[tuple[PreparedTrial, Array]]) -> GrowingNoise | None:
    """How the noise of a sensor grows, if it does.

    Args:
      left: trials and what an explanation leaves of this sensor in them / sigma, at their samples, (N,)
        each; NaN where nothing was read.
    """
    each = [_fitted(by, log, left) for by in ("rate", "torque")]
    found = [own for own in each if own is not None]
    if not found:
        return None
    gain, likeliest = max(found, key=lambda own: own[0])
    certain = gain > GROWING_LOG_LIKELIHOOD and likeliest.factor > GROWING_LEAST
    if not certain or not _white_where_large(likeliest, left):
        return None
    scaled = [values / likeliest.sizes(trial) for trial, values in left]
    return replace(likeliest, noise_ratio=white_noise(scaled, order=_ORDER))


def _fitted(
    by: GrowsWith, log: PreparedLog, left: Sequence[tuple[PreparedTrial, Array]]
) -> tuple[float, GrowingNoise] | None:
    """Twice the gain of the logarithm of the likelihood by growing, and the likeliest growth."""
    every = np.concatenate([_variable(by, trial) for trial in log.trials])
    largest = float(every.max())
    parts = [_apart(values, _variable(by, trial), _ORDER) for trial, values in left]
    differences, at = (np.concatenate([own[i] for own in parts]) for i in (0, 1))
    if differences.size < LEAST_DIFFERENCES or largest <= 0:
        return None

    def unlikely(factor: float) -> float:
        size = 1.0 + (factor - 1.0) * at / largest
        scaled = np.abs(differences) / size
        usual = np.minimum(scaled, _OUTLIER_SIGMA * np.median(scaled) / _MEDIAN)
        return float(differences.size * np.log(np.mean(usual**2)) + 2 * np.log(size).sum())

    best = minimize_scalar(unlikely, bounds=(1.0, GROWING_MOST), method="bounded")
    factor = float(best.x)
    growth = (factor - 1.0) / largest
    rms = math.sqrt(float(np.mean((1.0 + growth * every) ** 2)))
    found = GrowingNoise(grows_with=by, growth_per_unit=growth, factor=factor, rms_factor=rms)
    return unlikely(1.0) - float(best.fun), found


def _white_where_large(found: GrowingNoise, left: Sequence[tuple[PreparedTrial, Array]]) -> bool:
    """Whether differences of both orders tell the same noise where it is above its median."""
    sizes = [found.sizes(trial) for trial, _ in left]
    middle = float(np.median(np.concatenate(sizes)))
    seen = []
    for order in (1, _ORDER):
        both = [_apart(v / own, own, order) for (_, v), own in zip(left, sizes, strict=True)]
        large = np.concatenate([differences[own > middle] for differences, own in both])
        seen.append(float(np.median(np.abs(large))) if large.size else math.inf)
    return abs(math.log(seen[0] / seen[1])) < GROWING_WHITE


def _variable(by: GrowsWith, trial: PreparedTrial) -> Array:
    if by == "torque":
        return np.abs(trial.smooth_torque_n_mm)
    return np.abs(np.gradient(trial.base_motion_deg, trial.time_s))


def _apart(values: Array, variable: Array, order: int) -> tuple[Array, Array]:
    """Differences that share no sample, with the deviation of white noise, and x there, (M,) each."""
    read = np.isfinite(values)
    rows = np.count_nonzero(read) // (order + 1)
    own, at = (row[read][: rows * (order + 1)].reshape(rows, order + 1) for row in (values, variable))
    return np.diff(own, order, axis=1)[:, 0] / math.sqrt(binom(2 * order, order)), at.mean(axis=1)
