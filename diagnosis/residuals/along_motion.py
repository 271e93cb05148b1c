"""Residuals along the motion of the base: against its angle, its rate, and the time since it reversed.

This shows the law of a missing effect: dry friction changes with the sign of the rate, damping grows
with it, play and dry friction appear in the seconds after a reversal, a bent shaft over the angle.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from diagnosis.criteria.residuals import (
    ANGLE_PARTS,
    LEAST_IN_PART,
    RATE_PARTS_DEG_S,
    SINCE_REVERSAL_PARTS_S,
)
from diagnosis.log.trial import Trial
from diagnosis.residuals.motion import base_rate, since_reversal

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class Coordinate:
    """A coordinate of the motion, over which residuals are averaged.

    Attributes:
      of: returns its values at the samples of a trial, (N,).
      edges: returns the edges of its parts, from its values in all trials.
    """

    of: Callable[[Trial], Array]
    edges: Callable[[Sequence[Array]], Array]


def _twelfths(angles_deg: Sequence[Array]) -> Array:
    every = np.concatenate(angles_deg)
    return np.linspace(every.min(), every.max() * (1 + 1e-9) + 1e-9, ANGLE_PARTS + 1)


def _either_way(_: Sequence[Array]) -> Array:
    fast = np.asarray(RATE_PARTS_DEG_S)
    return np.concatenate([-fast[::-1], fast])


BASE_ANGLE = Coordinate(of=lambda trial: trial["base_angle_deg"], edges=_twelfths)
SINCE_REVERSAL = Coordinate(of=since_reversal, edges=lambda _: np.asarray(SINCE_REVERSAL_PARTS_S))
RATE = Coordinate(
    of=lambda trial: base_rate(trial["time_s"], trial["base_angle_deg"]), edges=_either_way
)


def part_means(
    places: Sequence[Array], values: Sequence[Array], edges: Array
) -> list[tuple[float, float]]:
    """Mean place and mean value in each part of a coordinate; parts of a few samples are left out.

    Args:
      places, values: by trial, (N,) each; values that are not finite are left out.
      edges: edges of the parts, ascending.
    """
    place, value = np.concatenate(places), np.concatenate(values)
    fine = np.isfinite(place) & np.isfinite(value)
    place, value = place[fine], value[fine]
    part = np.searchsorted(edges, place, side="right")
    each = [part == k for k in range(1, edges.size)]
    return [
        (float(place[own].mean()), float(value[own].mean()))
        for own in each
        if own.sum() >= LEAST_IN_PART
    ]
