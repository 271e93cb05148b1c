"""How much a reading scatters, in which steps it is read, and where it repeats itself."""

import math

import numpy as np
from numpy.typing import NDArray

from diagnosis.criteria.checks import NOISE_RATIO
from diagnosis.criteria.faults import BELIEVED_SCATTER, FROZEN_LEAST_RUN
from diagnosis.log.white_noise import white_noise

Array = NDArray[np.float64]


def scatter(values: Array) -> float:
    """Standard deviation of the white part of a reading, without its runs of equal values."""
    finite = values[np.isfinite(values)]
    starts, lengths = runs_of(finite)
    moving = finite[np.repeat(lengths < FROZEN_LEAST_RUN, lengths)] if starts.size else finite
    return white_noise([moving], order=2)


def quantum(values: Array) -> float:
    """The smallest step between two different readings; 0 if there is only one value."""
    steps = np.diff(np.unique(values[np.isfinite(values)]))
    # Decimal fractions differ by rounding alone in their last bits.
    steps = steps[steps > 1e-9 * np.nanmax(np.abs(values), initial=0.0)]
    return float(steps.min()) if steps.size else 0.0


def seen_scatter(values: Array, claim: float) -> float:
    """The smaller of claimed and found scatter; 0 if the readings show none."""
    found = scatter(values)
    if not claim > 0 or found < BELIEVED_SCATTER * claim:
        return 0.0
    least = min(claim, found) if math.isfinite(found) else claim
    return least if least >= 0.5 * quantum(values) else 0.0


def agrees(found: float, claim: float) -> bool:
    """Whether a scatter that was found agrees with a claim of noise."""
    low, high = NOISE_RATIO
    return low <= found / claim <= high


def runs_of(values: Array) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """First index and length of every run of equal values."""
    starts = np.flatnonzero(np.concatenate(([True], np.diff(values) != 0)))[: values.size]
    return starts, np.diff(np.concatenate((starts, [values.size])))
