"""Angles that wrap at the end of their range: +-180 deg (period 360), or +-90 deg for a sensor that
cannot tell the two ends of an axis apart (period 180).

At a wrap the reading jumps by a period against the direction in which it moves before and after;
or it jumps to and fro while it holds at the end of the range. No needle moves like this: a slip
continues in its own direction, and a turn from one hold to another has no motion at its ends. A few
readings that dropped to zero at half a turn jump back at once: they are outliers.
"""

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from diagnosis.criteria.faults import OUTLIER_MOST_RUN
from diagnosis.criteria.log import (
    WRAP_FLICKERS,
    WRAP_HELD,
    WRAP_MOTION_SIGMA,
    WRAP_PERIODS_DEG,
    WRAP_REMAINDER,
)
from diagnosis.criteria.prepare import GAP_STEPS
from diagnosis.log.checks.wording import lines
from diagnosis.log.trial import Trial, UnusableLog
from diagnosis.log.white_noise import white_noise

Array = NDArray[np.float64]
Rows = NDArray[np.intp]

_ANGLES = ("base_angle_deg", "tip_angle_deg")
_WINDOWS = (4, 8, 20)  # samples of each half before and after a jump


def refuse_wraps(path: Path, trial: Trial) -> None:
    """Refuse an angle that wraps.

    Raises:
      UnusableLog: names file, column, lines, and how to unwrap it.
    """
    for column in (name for name in _ANGLES if trial.has(name)):
        for period in WRAP_PERIODS_DEG:
            rows = wraps(trial["time_s"], trial[column], period)
            if rows.any():
                raise UnusableLog(
                    f"{path}: {column} wraps: it jumps by {period:g} deg against its own motion, "
                    f"{lines(rows)}; expected an angle that counts on; unwrap it: "
                    f"numpy.unwrap(values, period={period:g})"
                )


def wraps(time_s: Array, values_deg: Array, period_deg: float) -> NDArray[np.bool_]:
    """Rows at which an angle has wrapped, (N,); none unless some jump is a wrap for certain."""
    rows = np.zeros(values_deg.size, bool)
    finite = np.flatnonzero(np.isfinite(values_deg))
    read, steps = values_deg[finite], np.diff(time_s[finite])
    if read.size < 2:
        return rows
    jump = np.diff(read)
    near = np.abs(np.abs(jump) - period_deg) < WRAP_REMAINDER * period_deg
    at = np.flatnonzero(near & (steps <= GAP_STEPS * np.median(steps)))
    if at.size and (
        _moves_on(read, jump, _lasting(read, jump, at), period_deg)
        or _flickers(read, jump, at, period_deg)
    ):
        rows[finite[at + 1]] = True
    return rows


def _lasting(read: Array, jump: Array, at: Rows) -> Rows:
    """The jumps that are not undone within a few samples, as those of drop-outs are, nor undo one."""

    def undone(one: int) -> bool:
        after = np.abs(read[one + 2 : one + 2 + OUTLIER_MOST_RUN] - read[one])
        before = np.abs(read[max(one - OUTLIER_MOST_RUN, 0) : one] - read[one + 1])
        return bool(min(after.min(initial=np.inf), before.min(initial=np.inf)) < abs(jump[one]) / 2)

    return np.array([one for one in at.tolist() if not undone(one)], np.intp)


def _moves_on(read: Array, jump: Array, at: Rows, period_deg: float) -> bool:
    """Whether at one jump at least the angle moves against it, before and after."""
    unwrapped = np.unwrap(read, period=period_deg)
    noise = np.nan_to_num(white_noise([unwrapped], order=2))
    for i in at.tolist():
        for half in _WINDOWS:
            before, after = (
                unwrapped[max(i + 1 - 2 * half, 0) : i + 1],
                unwrapped[i + 1 : i + 1 + 2 * half],
            )
            if min(before.size, after.size) < 2 * half:
                continue
            moved = -np.sign(jump[i]) * np.array([_advance(before), _advance(after)])
            if moved.min() > WRAP_MOTION_SIGMA * noise * np.sqrt(2 / half):
                return True
    return False


def _advance(values: Array) -> float:
    """Mean of the second half minus mean of the first."""
    half = values.size // 2
    return float(values[half:].mean() - values[:half].mean())


def _flickers(read: Array, jump: Array, at: Rows, period_deg: float) -> bool:
    """Whether the angle repeatedly jumps to and fro between the ends of its range in a few samples.

    It holds there, so that all jumps are those of a period, but for the noise of two readings. A
    sensor that drops out gives one and the same reading from wherever it was: that is no wrap.
    """
    if _drops_out(read[at], read[at + 1]):
        return False
    off = np.abs(np.abs(jump) - period_deg)
    at = at[off[at] < WRAP_HELD * period_deg]
    signs, beside = np.sign(jump[at]), np.diff(at) <= min(_WINDOWS)
    back = beside & (signs[1:] == -signs[:-1])
    in_a_row = np.convolve(back, np.ones(WRAP_FLICKERS), "valid") if back.size >= WRAP_FLICKERS else back
    return bool((in_a_row >= WRAP_FLICKERS).any())


def _drops_out(before: Array, after: Array) -> bool:
    """Whether every jump starts or ends at one value exactly, and its other end varies."""
    low = np.where(np.abs(before) < np.abs(after), before, after)
    high = np.where(np.abs(before) < np.abs(after), after, before)
    return bool(np.ptp(low) == 0 < np.ptp(high))
