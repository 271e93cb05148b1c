"""Noise of a sensor that is another one in each trial.

A camera is focused anew, an amplifier's range is set, a cable is moved. The standard deviation in trial
i is then

    sigma r_i,    with the mean of r_i^2 over all samples = 1

Differences of order 2 of what an explanation leaves tell sigma r_i, without the largest, which outliers
make. The logarithm of it scatters by sqrt(1.25 / N) from N normal readings, and twice the logarithm of
the likelihood gains

    sum of N_i / 1.25 (log(sigma r_i) - its mean)^2

by noise of each trial of its own: of noise that is the same, chi-square of one less than there are
trials. Something fast that a model lacks in one of them is off in the same way from sample to sample:
differences of order 4 have to tell the same.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.stats import chi2

from diagnosis.criteria.faults import (
    TRIALS_NOISE_BY_CHANCE,
    TRIALS_NOISE_LEAST,
    TRIALS_NOISE_WHITE,
)
from diagnosis.log.white_noise import white_noise
from diagnosis.prepare.prepared_log import PreparedTrial

Array = NDArray[np.float64]

_ORDER, _OTHER_ORDER = 2, 4
_SCATTER = 1.25  # of the logarithm of noise: variance times the number of normal readings


@dataclass(frozen=True, kw_only=True)
class NoiseOfTrials:
    """How large the noise of a sensor is in each trial.

    Attributes:
      ratios: by trial, noise / its root mean square over all samples; 1 in others.
      noise_ratio: root mean square of the noise / what it was taken for.
    """

    ratios: Mapping[str, float]
    noise_ratio: float = 1.0

    def sizes(self, trial: PreparedTrial) -> Array:
        """Noise at every sample / its root mean square, (N,)."""
        return np.full(trial.time_s.size, self.ratios.get(trial.name, 1.0))

    @property
    def in_words(self) -> str:
        """How much it differs."""
        least, most = min(self.ratios.values()), max(self.ratios.values())
        return f"differs from trial to trial, between {least:.2f} and {most:.2f} times its mean"


def noise_of_trials(left: Sequence[tuple[PreparedTrial, Array]]) -> NoiseOfTrials | None:
    """How large the noise of a sensor is in each trial, if it differs.

    Args:
      left: trials and what an explanation leaves of this sensor in them / sigma, at their samples, (N,)
        each; NaN where nothing was read.
    """
    if len(left) < 2:
        return None
    readings = np.array([np.isfinite(values).sum() for _, values in left], float)
    told, others = (
        np.array([white_noise([values], order=order) for _, values in left])
        for order in (_ORDER, _OTHER_ORDER)
    )
    if not _all_white(told, others) or not _differ(readings, told):
        return None
    rms = math.sqrt(float(readings @ told**2 / readings.sum()))
    ratios = {trial.name: float(own / rms) for (trial, _), own in zip(left, told, strict=True)}
    return NoiseOfTrials(ratios=ratios, noise_ratio=rms)


def _all_white(told: Array, others: Array) -> bool:
    """Whether both orders tell the same noise, in every trial."""
    known = bool(np.all((told > 0) & (others > 0)))  # NaN: too short to tell
    return known and float(np.abs(np.log(told / others)).max()) < TRIALS_NOISE_WHITE


def _differ(readings: Array, told: Array) -> bool:
    """Whether the noise of trials differs by more than chance, and by so much that it counts."""
    sizes = np.log(told)
    mean = float(readings @ sizes / readings.sum())
    gain = float(readings @ (sizes - mean) ** 2) / _SCATTER
    certain = chi2.sf(gain, told.size - 1) < TRIALS_NOISE_BY_CHANCE
    return bool(certain) and float(told.max() / told.min()) > TRIALS_NOISE_LEAST
