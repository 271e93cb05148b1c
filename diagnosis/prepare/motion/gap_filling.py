"""The motion of the base across gaps in a log.

Where samples are missing, the base continued to move, and the needle's state depends on it. A cubic
through the readings on both sides follows a smooth motion across the gap, two lines that meet in it a
corner: the cubic is used unless only the lines fit both sides. Of a motion that changes beside the gap
the nearest readings tell. The filled rows have no sensor readings.

In a short gap nothing else is possible. In a longer one, or if neither fits, the difference of the two
is the uncertainty. If it is large, sensor readings after the gap are not used until the needle
no longer depends on it: for viscous drag, once its slowest mode has decayed to what is certain; for dry
friction, once the base has turned one way so far that the whole shaft slides.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from diagnosis.criteria.prepare import (
    GAP_CERTAIN_DEG,
    GAP_ERASED_TWISTS,
    GAP_FORGOTTEN_LENGTHS,
    GAP_FORGOTTEN_S,
    GAP_HELD_DEG_S,
    GAP_LONG_S,
    GAP_LOST_DEG,
    GAP_MISFIT,
    GAP_SHORT_S,
    GAP_SIDE_SAMPLES,
    GAP_STEPS,
    GAP_UNKNOWN_TWIST_DEG,
    GAP_USUAL_TWIST,
)
from diagnosis.log.trial import SENSORS, Trial

Array = NDArray[np.float64]

_BASE, _TIP = "base_angle_deg", "tip_angle_deg"
_HELD, _LOAD = ("inserted_mm", "free_mm", "speed_mm_s"), "tip_torque_n_mm"
_LEAST_SIDE = 4  # samples that a curve goes through on each side
_CUBIC = 3
_STILL_SIGMA = 4.0  # by which two readings of a base at rest may differ
_SLOW_SAMPLES, _LEAST_HELD = 10, 50  # that a rate is taken over; from which held samples tell a quantile


@dataclass(frozen=True, kw_only=True)
class Filling:
    """The content of a filled gap.

    Attributes:
      time_s, base_deg: motion of the base, (M,).
      uncertain_deg: uncertainty of this motion.
      tip_torque_n_mm: known torque at the tip, (M,); None: none.
      turned: whether the base may have turned there and back.
    """

    time_s: Array
    base_deg: Array
    tip_torque_n_mm: Array | None
    uncertain_deg: float
    turned: bool

    @property
    def length_s(self) -> float:
        """Approximate length of the gap, s."""
        return float(self.time_s[-1] - self.time_s[0])


def fill_gaps(trial: Trial, sigma_deg: float, memory_s: float = 0.0) -> Trial:
    """The trial with rows in its gaps: estimated readings of the encoder, none of the sensors.

    Args:
      sigma_deg: noise of the base's encoder.
      memory_s: slowest time constant of the needle.
    """
    steps = np.diff(trial["time_s"])
    usual = float(np.median(steps))
    gaps = np.flatnonzero(steps > GAP_STEPS * usual)
    if not gaps.size:
        return trial
    fillings = [_filling(trial, int(before), usual, sigma_deg) for before in gaps]
    table = pd.concat([trial.table, _rows(trial, fillings)]).sort_values("time_s", ignore_index=True)
    lost = _lost(trial, fillings, np.asarray(table["time_s"]), memory_s)
    table.loc[lost, [sensor for sensor in SENSORS if sensor in table]] = np.nan
    return replace(trial, table=table)


def _rows(trial: Trial, fillings: Sequence[Filling]) -> pd.DataFrame:
    time_s = np.concatenate([filling.time_s for filling in fillings])
    rows = {"time_s": time_s, _BASE: np.concatenate([filling.base_deg for filling in fillings])}
    for name in _HELD:
        if name in trial.table:
            rows[name] = np.interp(time_s, trial["time_s"], np.nan_to_num(trial[name]))
    loads = [filling.tip_torque_n_mm for filling in fillings if filling.tip_torque_n_mm is not None]
    if loads:
        rows[_LOAD] = np.concatenate(loads)
    return pd.DataFrame(rows)


def _filling(trial: Trial, before: int, usual_s: float, sigma_deg: float) -> Filling:
    """The filling of the gap between the sample `before` and the next."""
    time, base = trial["time_s"], trial[_BASE]
    start, end = time[before], time[before + 1]
    inside = np.linspace(start, end, max(round((end - start) / usual_s), 2) + 1)[1:-1]
    most = int(np.clip((end - start) / usual_s, _LEAST_SIDE, GAP_SIDE_SAMPLES))
    tried = [_curves(time, base, before, inside, n, sigma_deg) for n in _fewer_and_fewer(most)]
    curves = next((own for own in tried if own.fit), tried[-1])
    certain = curves.fit and end - start <= GAP_SHORT_S
    path = _held_between(curves.path, base, before, sigma_deg)
    one_way = np.abs(np.diff(path)).sum() - np.abs(path[-1] - path[0]) <= GAP_CERTAIN_DEG
    return Filling(
        time_s=inside,
        base_deg=path,
        tip_torque_n_mm=_load(trial, curves.around, inside),
        uncertain_deg=0.0 if certain else float(np.abs(curves.smooth_deg - curves.corner_deg).max()),
        turned=bool(end - start > GAP_LONG_S or not curves.fit or not one_way),
    )


@dataclass(frozen=True, kw_only=True, eq=False)
class _Curves:
    """Two curves across a gap, (M,), through the rows around it, and which of them fit the readings."""

    around: slice
    smooth_deg: Array
    corner_deg: Array
    smooth_fits: bool
    corner_fits: bool

    @property
    def fit(self) -> bool:
        """Whether one of them does."""
        return self.smooth_fits or self.corner_fits

    @property
    def path(self) -> Array:
        """The smooth one, unless the corner alone fits."""
        return self.corner_deg if self.corner_fits and not self.smooth_fits else self.smooth_deg


def _curves(
    time_s: Array, base_deg: Array, before: int, at_s: Array, side: int, sigma_deg: float
) -> _Curves:
    """Curves through so many readings on each side of the gap after the sample `before`."""
    left = slice(max(before + 1 - side, 0), before + 1)
    right = slice(before + 1, before + 1 + side)
    both = slice(left.start, right.stop)
    smooth, off = _through(time_s[both], base_deg[both], at_s, _CUBIC)
    corner, off_lines = _corner(time_s, base_deg, left, right, at_s)
    most = GAP_MISFIT * max(sigma_deg, 1e-9)
    return _Curves(
        around=both,
        smooth_deg=smooth,
        corner_deg=corner,
        smooth_fits=off <= most,
        corner_fits=off_lines <= most,
    )


def _fewer_and_fewer(most: int) -> Iterator[int]:
    """Readings on each side that a curve goes through, the nearest four last."""
    while most > _LEAST_SIDE:
        yield most
        most //= 2
    yield _LEAST_SIDE


def _held_between(path: Array, base_deg: Array, before: int, sigma_deg: float) -> Array:
    """The path, between the readings at its ends where the base does not turn back in between.

    A curve that overshoots by a presliding angle turns dry friction near the chuck around.
    """
    sides = (
        slice(max(before + 1 - _LEAST_SIDE, 0), before + 1),
        slice(before + 1, before + 1 + _LEAST_SIDE),
    )
    ends = base_deg[before], base_deg[before + 1]
    moved = [ends[1] - ends[0], *(base_deg[side][-1] - base_deg[side][0] for side in sides)]
    ways = {float(np.sign(own)) for own in moved if abs(own) > _STILL_SIGMA * sigma_deg}
    return path if len(ways) > 1 else np.clip(path, min(ends), max(ends))


def _through(time_s: Array, base_deg: Array, at_s: Array, order: int) -> tuple[Array, float]:
    """A polynomial at some times, and the root mean square of its residual."""
    middle, scale = at_s.mean(), np.ptp(time_s) or 1.0
    powers = np.vander((time_s - middle) / scale, order + 1)
    factors = np.linalg.lstsq(powers, base_deg, rcond=None)[0]
    freedom = max(time_s.size - order - 1, 1)
    missed = float(np.sqrt(np.sum((base_deg - powers @ factors) ** 2) / freedom))
    return np.vander((at_s - middle) / scale, order + 1) @ factors, missed


def _load(trial: Trial, around: slice, at_s: Array) -> Array | None:
    """The torque at the tip in a gap, (M,), which goes on as smoothly as the base; None: none is known.

    Lines would cut the top off a torque that turns in the gap.
    """
    if _LOAD not in trial.table:
        return None
    return _through(trial["time_s"][around], np.nan_to_num(trial[_LOAD][around]), at_s, _CUBIC)[0]


def _corner(
    time_s: Array, base_deg: Array, left: slice, right: slice, at_s: Array
) -> tuple[Array, float]:
    """Lines through both sides that meet in the gap, and their residual; else one line."""
    straight = np.interp(at_s, time_s, base_deg)
    if min(left.stop - left.start, time_s[right].size) < _LEAST_SIDE:
        return straight, np.inf
    (one, off_one), (other, off_other) = (
        _through(time_s[side], base_deg[side], at_s, 1) for side in (left, right)
    )
    ahead = one > other
    if at_s.size < 2 or ahead[0] == ahead[-1]:
        return straight, np.inf
    return np.where(ahead == ahead[0], one, other), max(off_one, off_other)


def _lost(
    trial: Trial, fillings: Sequence[Filling], time_s: Array, memory_s: float
) -> NDArray[np.bool_]:
    """Mask of rows that still depend on an uncertain motion, (N,)."""
    rows = np.zeros(time_s.size, bool)
    for filling in fillings:
        if filling.uncertain_deg > GAP_CERTAIN_DEG:
            last = filling.time_s[-1]
            short = filling.length_s <= GAP_SHORT_S
            decayed_s = memory_s * math.log(filling.uncertain_deg / GAP_CERTAIN_DEG)
            long_s = max(GAP_FORGOTTEN_S, decayed_s)
            until = last + (min(GAP_FORGOTTEN_LENGTHS * filling.length_s, long_s) if short else long_s)
            if filling.uncertain_deg > GAP_LOST_DEG and filling.turned and not short:
                until = max(until, _erased_s(trial, last))
            rows |= (time_s > last) & (time_s <= until)
    return rows


def _erased_s(trial: Trial, after_s: float) -> float:
    """First time after which the base has turned one way so far that the whole shaft slides, s."""
    rows = trial["time_s"] > after_s
    time, base = trial["time_s"][rows], trial[_BASE][rows]
    turned = np.maximum(base - np.minimum.accumulate(base), np.maximum.accumulate(base) - base)
    far = np.flatnonzero(turned >= GAP_ERASED_TWISTS * _usual_twist_deg(trial))
    return float(time[far[0]]) if far.size else np.inf


def _usual_twist_deg(trial: Trial) -> float:
    """Twist of the shaft while the base is slow, which dry friction holds; else at any time, deg."""
    if not trial.has(_TIP):
        return GAP_UNKNOWN_TWIST_DEG
    twist = np.abs(trial[_BASE] - trial[_TIP])
    about = np.convolve(trial[_BASE], np.ones(_SLOW_SAMPLES) / _SLOW_SAMPLES, "same")
    slow = np.abs(np.gradient(about, trial["time_s"])) < GAP_HELD_DEG_S
    held = slow & np.isfinite(twist)
    return float(np.nanquantile(twist[held] if held.sum() > _LEAST_HELD else twist, GAP_USUAL_TWIST))
