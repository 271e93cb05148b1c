"""A sensor that holds its reading over n rows, where noise is added in every row: a tracker that a fast
logger reads by its analog output.

No two rows are alike, but the motion comes in steps. With m what a smooth curve changes by from one row
to the next, the differences of the readings are

    d = m + noise           where every row shows what is
    d = n m + noise         at the first row of each n, and noise alone at the others, where it is held

so that the squares tell which, with h = n or 0 by the row and v the variance of that noise:

    evidence = sum of ((d - m)^2 - (d - h m)^2) / v

On average it is plus the sum of (h m - m)^2 / v if readings are held, and minus that if not. Where the
base moves in such steps itself, by a controller that is slower than the logger, nothing is held.
"""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.signal import savgol_filter

from diagnosis.criteria.faults import HELD_EVIDENCE, HELD_MOST_ROWS, HELD_SHARE
from diagnosis.log.trial import Trial

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

_BASE = "base_angle_deg"
_ROWS = range(2, HELD_MOST_ROWS + 1)
_SMOOTH_ROWS, _DEGREE = 6, 2  # times the rows of a hold, for the curve


_Hold = tuple[float, float, int]
"""Evidence that readings are held, what it would be on average, and the row of each n that is new."""
_UNKNOWN: _Hold = 0.0, 0.0, 0


def held_rows(trials: Sequence[Trial], column: str, claim: float) -> list[Mask]:
    """Rows of each trial that show the reading before, (N,) each; none where the motion tells of none.

    Args:
      claim: claimed noise of the column; 0: there is none, and nothing is known.
    """
    none = [np.zeros(trial["time_s"].size, bool) for trial in trials]
    if not claim > 0:
        return none
    each = {rows: [_held(trial, column, rows) for trial in trials] for rows in _ROWS}
    rows = max(each, key=lambda n: sum(evidence for evidence, _, _ in each[n]))
    if not _is_sure(each[rows]) or _is_sure([_held(trial, _BASE, rows) for trial in trials]):
        return none
    found = zip(trials, each[rows], strict=True)
    return [_numbers(trial["time_s"]) % rows != new for trial, (_, _, new) in found]


def _numbers(time_s: Array) -> Array:
    """Numbers of rows, (N,), that go on across those that are missing."""
    steps_s = np.diff(time_s)
    passed = np.rint(steps_s / np.median(steps_s)) if steps_s.size else steps_s
    return np.concatenate([[0.0], np.cumsum(np.maximum(passed, 1.0))])


def _is_sure(each: Sequence[_Hold]) -> bool:
    evidence, expected = sum(own for own, _, _ in each), sum(own for _, own, _ in each)
    return evidence > max(HELD_EVIDENCE, HELD_SHARE * expected)


def _held(trial: Trial, column: str, rows: int) -> _Hold:
    """The likeliest hold of one trial over so many rows."""
    if not trial.has(column):
        return _UNKNOWN
    values, at = trial[column], _numbers(trial["time_s"])
    size, read = 2 * _SMOOTH_ROWS * rows + 1, np.isfinite(values)
    both = np.flatnonzero(read[:-1] & read[1:] & (np.diff(at) == 1.0))
    if both.size < 2 * size:
        return _UNKNOWN
    slopes = savgol_filter(np.interp(at, at[read], values[read]), size, _DEGREE, deriv=1)
    moved, found = 0.5 * (slopes[both] + slopes[both + 1]), np.diff(values)[both]
    return max(_likeliness(moved, found, at[both + 1] % rows == new, rows, new) for new in range(rows))


def _likeliness(moved: Array, found: Array, is_new: Mask, rows: int, new: int) -> _Hold:
    """How likely differences are those of a hold whose new readings are known, (N,) each."""
    held = rows * is_new * moved
    variance = max(float(np.mean((found - held) ** 2)), np.finfo(float).tiny)
    evidence = np.sum((found - moved) ** 2 - (found - held) ** 2) / variance
    return float(evidence), float(np.sum((held - moved) ** 2) / variance), new
