"""The shape of the loops of torque over base angle: stiffness, play, dry level.

After a reversal dry friction holds the needle behind it: the torque falls from one level to the
opposite one, first along the stiffness of the part that the drive twists, then flat within play,
then along the stiffness again.

         level  ----.                      u = 0
                     \\   stiffness
                      '---------.          u = 1/2
                         play    \\
                                  '-----   u = 1

With u the share of that change, one straight line is fitted to the torque at u between 0.1 and 0.3,
another between 0.7 and 0.9. Their slopes give the stiffness, their distance in angle at u = 1/2 the
play, half of the whole change the level. Each is the median over the reversals, with their scatter. This
describes the loops, and is no model: viscous torque widens them, too. The torque that is kept at rest
has no viscous part: only dry friction holds it.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from diagnosis.criteria.lab_files import BRANCH_LEAST_NOISE, FIRST_QUARTERS, LAST_QUARTERS, PLATEAU
from diagnosis.lab_files.motion import Motion
from diagnosis.lab_files.readers.lab_table import Array


@dataclass(frozen=True, kw_only=True)
class Branch:
    """The part of a loop from one reversal to the next.

    Attributes:
      angle, torque: (N,).
      rate_per_s: mean rate, angle per second.
      first: whether it is the first of a trial, without a reversal before it.
    """

    angle: Array
    torque: Array
    rate_per_s: float
    first: bool


@dataclass(frozen=True, kw_only=True)
class LoopValue:
    """A quantity of the loops: median over reversals, and scatter (1.48 median absolute deviations)."""

    value: float | None
    scatter: float | None
    reversals: int

    def told(self, unit: str) -> str:
        """The value in words, with a unit."""
        if self.value is None or self.scatter is None:
            return "not seen"
        if self.reversals == 1:
            return f"{self.value:.3g} {unit} (once)"
        return f"{self.value:.3g} ± {self.scatter:.2g} {unit} ({self.reversals} times)"


@dataclass(frozen=True, kw_only=True)
class LoopShape:
    """The shape of the loops of torque over angle, in the units of both.

    Attributes:
      stiffness: slope after a reversal, torque per angle.
      play: angle over which torque stays at the middle after a reversal.
      level: half of the torque's change between the directions.
      middle: torque halfway between both directions.
      kept: torque at the end of a rest, along the turn before it.
      rates_per_s: slowest and fastest turn of these loops, angle per second.
    """

    stiffness: LoopValue
    play: LoopValue
    level: LoopValue
    middle: LoopValue
    kept: LoopValue
    rates_per_s: tuple[float, float]


def loop_shape(branches: Sequence[Branch], kept: Sequence[float], noise: float) -> LoopShape:
    """Shape of loops from their branches.

    Args:
      branches: from one reversal to the next, in the order of time.
      kept: torque at the end of rests, along the turn before each.
      noise: standard deviation of the torque; branches with hardly more change than noise are left out.
    """
    stiffness, play, level, middle, rates = [], [], [], [], []
    ends = [_plateau(branch) for branch in branches]
    for i in range(1, len(branches)):
        before, after = ends[i - 1], ends[i]
        if (
            branches[i].first
            or before is None
            or after is None
            or abs(after - before) <= BRANCH_LEAST_NOISE * noise
        ):
            continue
        angle, torque = branches[i].angle, branches[i].torque
        # A torque that changes as the base turns has the sign of the turn.
        forth = np.sign(angle[-1] - angle[0])
        if forth * (after - before) <= 0:
            continue
        level.append(abs(after - before) / 2)
        middle.append((after + before) / 2)
        rates.append(branches[i].rate_per_s)
        share = (torque - before) / (after - before)
        lines = [_line(angle, share, *quarters) for quarters in (FIRST_QUARTERS, LAST_QUARTERS)]
        if None not in lines:
            (slope_1, at_1), (slope_2, at_2) = (line for line in lines if line)
            stiffness.append(abs(after - before) * (abs(slope_1) + abs(slope_2)) / 2)
            play.append(max(forth * (at_2 - at_1), 0.0))
    return LoopShape(
        stiffness=_pooled(stiffness),
        play=_pooled(play),
        level=_pooled(level),
        middle=_pooled(middle),
        kept=_pooled(kept),
        rates_per_s=(min(rates, default=0.0), max(rates, default=0.0)),
    )


def branches_of(motion: Motion, angle: Array, torque: Array) -> list[Branch]:
    """Angle and torque between reversals of one trial, without samples at rest.

    Args:
      motion: of the base; angle and torque are at its times, (N,).
    """
    edges = [0, *motion.reversals, angle.size]
    found: list[Branch] = []
    for a, b in pairwise(edges):
        moving = ~motion.resting[a:b] & np.isfinite(torque[a:b]) & np.isfinite(angle[a:b])
        if moving.sum() > 2:
            x, y = angle[a:b][moving], torque[a:b][moving]
            rate = _rate(motion.time_s[a:b][moving], x)
            found.append(Branch(angle=x, torque=y, rate_per_s=rate, first=not found))
    return found


def kept_torques(motion: Motion, angle: Array, torque: Array) -> list[float]:
    """Torque in the last half of each rest after a turn, positive along that turn."""
    found: list[float] = []
    for (_, before), (first, last) in pairwise(((motion.time_s[0],) * 2, *motion.rests_s)):
        start = np.searchsorted(motion.time_s, before)
        for i in motion.reversals:
            start = max(start, i) if motion.time_s[i] < first else start
        stop = np.searchsorted(motion.time_s, first)
        way = angle[min(stop, angle.size - 1)] - angle[start]
        inside = (motion.time_s >= (first + last) / 2) & (motion.time_s <= last) & np.isfinite(torque)
        if way != 0 and inside.any() and first > motion.time_s[0]:
            found.append(float(np.sign(way) * np.mean(torque[inside])))
    return found


def _rate(time_s: Array, angle: Array) -> float:
    """Rate over the middle of a turn."""
    share = np.abs(angle - angle[0]) / max(float(np.abs(angle - angle[0]).max()), 1e-12)
    middle = (share > FIRST_QUARTERS[0]) & (share < LAST_QUARTERS[1])
    spent_s = float(np.count_nonzero(middle) * np.median(np.diff(time_s)))
    return float(np.ptp(angle[middle])) / spent_s if spent_s > 0 else 0.0


def _plateau(branch: Branch) -> float | None:
    """Torque near the end of a branch, before the base slows down."""
    angle, torque = branch.angle, branch.torque
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


def _pooled(values: Sequence[float]) -> LoopValue:
    if not values:
        return LoopValue(value=None, scatter=None, reversals=0)
    middle = float(np.median(values))
    scatter = 1.4826 * float(np.median(np.abs(np.array(values) - middle)))
    return LoopValue(value=middle, scatter=scatter, reversals=len(values))
