"""What the loops of torque over base angle look like: stiffness, play, dry level.

After a reversal a dry contact holds what lies behind it: the torque falls from one level to the opposite
one, first along the stiffness of what the drive winds up, flat where there is play, and along the
stiffness again.

         level  ----.                      u = 0
                     \\   stiffness
                      '---------.          u = 1/2
                         play    \\
                                  '-----   u = 1

With u the share of that way, a straight line is put through the torque where u is between 0.1 and 0.3,
another between 0.7 and 0.9. Their slopes are the stiffness, the angle between them at u = 1/2 the play,
half of the whole way the level. Each is the median over the reversals, with their scatter. This is
what the loops look like, not a model: viscous torque widens them too.
"""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from diagnosis.criteria import BRANCH_LEAST_NOISE, FIRST_QUARTERS, LAST_QUARTERS, PLATEAU
from diagnosis.lab_files.motion import Motion
from diagnosis.lab_files.readers.lab_table import Array


@dataclass(frozen=True, kw_only=True)
class LoopValue:
    """A quantity of the loops: median over reversals and scatter (1.48 median absolute deviations)."""

    value: float | None
    scatter: float | None
    reversals: int

    def told(self, unit: str) -> str:
        """In words, with a unit."""
        if self.value is None or self.scatter is None:
            return "no reversal shows it"
        times = f"{self.reversals} reversal{'s' if self.reversals > 1 else ''}"
        return f"{self.value:.4g} ± {self.scatter:.2g} {unit} ({times})"


@dataclass(frozen=True, kw_only=True)
class LoopShape:
    """What the loops of torque over angle look like, in the units of both.

    Attributes:
      stiffness: slope after a reversal, torque per angle.
      play: angle over which torque stays at the middle after a reversal.
      level: half of what the torque changes by from one direction to the other.
      middle: torque halfway between both directions.
    """

    stiffness: LoopValue
    play: LoopValue
    level: LoopValue
    middle: LoopValue


def loop_shape(branches: list[tuple[Array, Array]], noise: float) -> LoopShape:
    """Shape of loops from their branches.

    Args:
      branches: angle and torque from one reversal to the next, (N,) each, in the order of time.
      noise: standard deviation of the torque; branches that change it by little more are left out.
    """
    stiffness, play, level, middle = [], [], [], []
    ends = [_plateau(angle, torque) for angle, torque in branches]
    for i in range(1, len(branches)):
        before, after = ends[i - 1], ends[i]
        if before is None or after is None or abs(after - before) <= BRANCH_LEAST_NOISE * noise:
            continue
        angle, torque = branches[i]
        # A torque that changes as the base turns has the sign of the turn.
        forth = np.sign(angle[-1] - angle[0])
        if forth * (after - before) <= 0:
            continue
        level.append(abs(after - before) / 2)
        middle.append((after + before) / 2)
        share = (torque - before) / (after - before)
        lines = [_line(angle, share, *quarters) for quarters in (FIRST_QUARTERS, LAST_QUARTERS)]
        if None not in lines:
            (slope_1, at_1), (slope_2, at_2) = (line for line in lines if line)
            stiffness.append(abs(after - before) * (abs(slope_1) + abs(slope_2)) / 2)
            play.append(max(forth * (at_2 - at_1), 0.0))
    return LoopShape(
        stiffness=_pooled(stiffness), play=_pooled(play), level=_pooled(level), middle=_pooled(middle)
    )


def branches_of(motion: Motion, angle: Array, torque: Array) -> list[tuple[Array, Array]]:
    """Angle and torque between reversals, without samples at rest.

    Args:
      motion: of the base; angle and torque are at its times, (N,).
    """
    edges = [0, *motion.reversals, angle.size]
    found = []
    for a, b in pairwise(edges):
        moving = ~motion.resting[a:b] & np.isfinite(torque[a:b]) & np.isfinite(angle[a:b])
        if moving.sum() > 2:
            found.append((angle[a:b][moving], torque[a:b][moving]))
    return found


def _plateau(angle: Array, torque: Array) -> float | None:
    """Torque near the end of a branch, before the base slows down."""
    turned = np.abs(angle - angle[0])
    near = (turned >= PLATEAU[0] * turned.max()) & (turned <= PLATEAU[1] * turned.max())
    return float(np.median(torque[near])) if near.any() else None


def _line(angle: Array, share: Array, low: float, high: float) -> tuple[float, float] | None:
    """Slope of the share over the angle between two shares, and the angle at half."""
    above = np.flatnonzero(share >= low)
    beyond = np.flatnonzero(share >= high)
    if above.size == 0 or beyond.size == 0 or above[0] == 0:
        return None
    # Between the two crossings; a sample on either side where few are inside.
    first, last = int(above[0]) - 1, int(beyond[0])
    inside = slice(first, last + 1)
    x, y = angle[inside], share[inside]
    if np.ptp(x) == 0:
        return None
    slope, offset = np.polyfit(x, y, 1)
    return (float(slope), float((0.5 - offset) / slope)) if slope else None


def _pooled(values: list[float]) -> LoopValue:
    if not values:
        return LoopValue(value=None, scatter=None, reversals=0)
    middle = float(np.median(values))
    scatter = 1.4826 * float(np.median(np.abs(np.array(values) - middle)))
    return LoopValue(value=middle, scatter=scatter, reversals=len(values))
