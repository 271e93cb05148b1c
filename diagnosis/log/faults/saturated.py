"""Saturated readings: those that stand at an end of the range of a sensor.

If more readings are exactly there than within one scatter of it, half of what would have scattered
across the end was cut off.
"""

from collections.abc import Collection, Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from diagnosis.criteria.faults import (
    SATURATED_BESIDE,
    SATURATED_LEAST_RUN,
    SATURATED_NEAR_SIGMA,
    SATURATED_SHARE,
)
from diagnosis.log.faults.scatter import quantum, seen_scatter
from diagnosis.log.trial import Trial

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]


def ends_of_ranges(trials: Sequence[Trial], noise: Mapping[str, float]) -> dict[str, set[float]]:
    """By sensor: the ends of its range at which readings of a trial stand, and those of the other sign.

    They are the sensor's: readings that are exactly there are saturated in every trial, though few.
    """
    found: dict[str, set[float]] = {name: set() for name in noise}
    for trial in trials:
        for name in (n for n in noise if trial.has(n)):
            ends = _ends(trial[name], noise[name])
            found[name].update(ends, [-end for end in ends])
    return found


def saturated_rows(values: Array, claim: float, ends: Collection[float]) -> Mask:
    """Mask of saturated readings, given ends of the range that other trials show."""
    rows = np.isin(values, [*_ends(values, claim), *ends])
    # Between samples at the end, those that noise alone took off it are no better.
    return np.convolve(rows, np.ones(2 * SATURATED_BESIDE + 1), "same") > 0 if rows.any() else rows


def _ends(values: Array, claim: float) -> list[float]:
    """Ends of the range at which more readings stand than are within one scatter of them."""
    width = max(seen_scatter(values, claim), quantum(values))
    if seen_scatter(values, claim) == 0 or np.nanmin(values) == np.nanmax(values):
        return []
    found = []
    for end in (np.nanmin(values), np.nanmax(values)):
        at, near = values == end, np.abs(values - end) <= SATURATED_NEAR_SIGMA * width
        if at.sum() >= SATURATED_LEAST_RUN and at.sum() > SATURATED_SHARE * near.sum():
            found.append(float(end))
    return found
