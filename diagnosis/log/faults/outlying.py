"""Outliers beside a model: residuals far off in short runs, while those about them are not.

Beside a model an outlier stands alone, where beside the samples on both sides several in a row, or a low
rate, tell too little. What an unmodelled effect leaves lasts, or comes at every reversal.
"""

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import median_filter

from diagnosis.criteria.faults import (
    OUTLIER_LEFT_MOST_RUN,
    OUTLIER_LEFT_NEIGHBOURS,
    OUTLIER_LEFT_QUIET_SIGMA,
    OUTLIER_LEFT_SIGMA,
    OUTLIER_MOST_LEFT,
)

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

_ABOUT = 20  # times the longest run: readings whose median an outlier is off


def outlying(left: Array) -> Mask:
    """Mask of residuals that are far off in short runs, with quiet neighbours on both sides, (N,).

    They are off what the readings about them are off by: a drift of the sensor hides none. In a burst of
    them, fewer quiet ones than there are neighbours do not part it, and those at its ends may be off by
    less.

    Args:
      left: residuals / sigma, (N,).
    """
    rows = np.zeros(left.size, bool)
    level = median_filter(left, _ABOUT * OUTLIER_LEFT_MOST_RUN + 1, mode="reflect")
    away = np.abs(left - level + np.clip(level, -1.0, 1.0))  # a level within the noise is none
    off = np.flatnonzero(away >= OUTLIER_LEFT_QUIET_SIGMA)
    runs = np.split(off, np.flatnonzero(np.diff(off) > OUTLIER_LEFT_NEIGHBOURS) + 1) if off.size else []
    for start, end in ((int(run[0]), int(run[-1]) + 1) for run in runs):
        far = away[start:end].max() > OUTLIER_LEFT_SIGMA
        if not far or end - start > OUTLIER_LEFT_MOST_RUN:
            continue
        if start >= OUTLIER_LEFT_NEIGHBOURS and end <= left.size - OUTLIER_LEFT_NEIGHBOURS:
            rows[start:end] = True
    return rows


def few(rows: Mask) -> bool:
    """Whether outliers are few among the readings of a sensor."""
    return bool(rows.sum() <= max(OUTLIER_MOST_LEFT * rows.size, 1.0))


def without_few(left: Array) -> Array:
    """Residuals / sigma with NaN for outliers, if they are few, (N,)."""
    rows = np.zeros(left.size, bool)
    finite = np.isfinite(left)
    rows[finite] = outlying(left[finite])
    return np.where(rows, np.nan, left) if few(rows) else left
