"""Samples that were taken unevenly, and stamped as if they had been even.

A busy computer reads a row late by d and stamps it by its count. All columns were read at the same
moment, so the base tells when: beside the curve B through its neighbours the reading is

    b - B = dB/dt d + noise,    variance = rate^2 jitter^2 + noise^2

The curve is the local cubic in the window that leaves the least; a reading beside the curve through
the others has this variance and that of the curve. The two parts are told apart by the rates of the
motion: the scatter of an encoder does not grow with them, nor does that of its rounding. What a curve
does not follow is off in the same way from sample to sample, jitter is not.

Rows may be missing: the cubic goes through those that are there.

The best linear estimate of d then is the time by which a sample is moved. What it leaves is an error
of the curve, which base, tip and torque share.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import PchipInterpolator
from scipy.optimize import nnls

from diagnosis.criteria.log import (
    JITTER_CERTAIN_SIGMA,
    JITTER_LEAST_STEPS,
    JITTER_MOST_ALIKE,
    JITTER_MOST_BEYOND,
    JITTER_MOST_STEPS,
)
from diagnosis.log.times.adaptive_curve import Scatter, adaptive_curve
from diagnosis.log.trial import FileRows, Trial

Array = NDArray[np.float64]
Counts = NDArray[np.intp]
Mask = NDArray[np.bool_]

_BASE = "base_angle_deg"
_WIDTHS = (5, 7, 11, 17, 25, 41)  # samples
_ORDER = 3
_MOST_OWN = 0.7  # weight of a reading in the curve, beyond which its neighbours are too few
_EVEN = 0.02  # of a step
_MOVING = 0.1  # of the fastest rate, from which a sample moves
_FEWEST = 50  # samples that move
_BINS, _STEPS = 8, 10
_MAD = 0.6745  # median size of a normal distribution, in sigma
_EFFICIENCY = 0.37  # of a median of squares beside their mean
_OUTLIER_SIGMA = 4.0
_EXAMPLES = 4


@dataclass(frozen=True, kw_only=True, eq=False)
class _Beside:
    """Readings of the base beside the curve through the others, at even steps.

    Attributes:
      off: reading minus curve, deg, (N,); NaN where the neighbours are too few.
      rate: of the curve, deg/s, (N,); 0 there.
      gain: standard deviation of `off`, in that of a reading, (N,).
      moves: samples whose rate tells a jitter, (N,).
    """

    off: Array
    rate: Array
    gain: Array
    moves: Mask
    rows: Counts
    step_s: float

    @property
    def late_s(self) -> Array:
        """By how much samples that move are late if all that is off were jitter, s, (M,)."""
        return self.off[self.moves] / self.rate[self.moves]

    def variance(self, scatter: Scatter) -> Array:
        """Of what readings are off by, deg^2, (N,)."""
        return (self.rate**2 * scatter.jitter_s**2 + scatter.noise_deg**2) * self.gain**2


def with_sampling_times(trials: Sequence[Trial]) -> tuple[list[Trial], list[str]]:
    """The trials with the times that their base tells, if it does; warnings.

    Trials of other rates may be off by the same time, or by the same share of their steps.
    """
    each = [_beside(trial) for trial in trials]
    told = [own for own in each if own is not None]
    if not told:
        return list(trials), []
    alike = [_scatter(told, units_s) for units_s in ([1.0] * len(told), [own.step_s for own in told])]
    scatters, certainty_sigma = max(alike, key=lambda found: found[1])
    shares = [found.jitter_s / own.step_s for found, own in zip(scatters, told, strict=True)]
    jitters = JITTER_LEAST_STEPS < float(np.median(shares)) < JITTER_MOST_STEPS
    if not jitters or certainty_sigma <= JITTER_CERTAIN_SIGMA or _alike(told) > JITTER_MOST_ALIKE:
        return list(trials), []
    if _beyond(told, scatters) > JITTER_MOST_BEYOND:
        return list(trials), []
    jitter_s, step_s = max((own.jitter_s, one.step_s) for own, one in zip(scatters, told, strict=True))
    said = (
        "base_angle_deg scatters in proportion to its rate, as rows do that were read "
        f"{_ms(jitter_s)} early or late (rms) under stamps {_ms(step_s)} apart: every row is "
        "moved to the time that its base angle tells; stamp rows when they are read"
    )
    of = iter(scatters)
    pairs = zip(trials, each, strict=True)
    return [trial if own is None else _moved(trial, own, next(of)) for trial, own in pairs], [said]


def _ms(time_s: float) -> str:
    return f"{1e3 * time_s:.2g} ms"


def _beside(trial: Trial) -> _Beside | None:
    """With the window that leaves the least; None if the trial does not move, or is not even."""
    time_s, base = trial["time_s"], trial[_BASE]
    steps = np.diff(time_s)
    step_s = float(np.median(steps))
    counts = np.rint(steps / step_s)
    if not np.isfinite(base).all() or np.abs(steps - counts * step_s).max() > _EVEN * step_s:
        return None
    rows = np.append(0, np.cumsum(np.minimum(counts, _WIDTHS[-1]))).astype(int)
    found = [_in_window(base, rows, width, step_s) for width in _WIDTHS if 4 * width <= base.size]
    telling = [own for own in found if own.moves.sum() >= _FEWEST]
    return min(telling, key=lambda own: np.median(np.abs(own.late_s)), default=None)


def _in_window(base: Array, rows: Counts, width: int, step_s: float) -> _Beside:
    """Normal equations of the cubic from moments of the readings that are there.

    Args:
      rows: place of each reading on the even grid, (N,).
    """
    steps = np.arange(width) - width // 2
    there, values = np.zeros((2, rows[-1] + 1 + 2 * (width // 2)))
    there[rows + width // 2] = 1.0
    values[rows + width // 2] = base
    powers = [(steps / width) ** k for k in range(2 * _ORDER + 1)]
    counted = np.stack([np.correlate(there, own, "valid")[rows] for own in powers], axis=-1)
    weighted = np.stack([np.correlate(values, own, "valid")[rows] for own in powers[: _ORDER + 1]], -1)
    normal = counted[:, np.add.outer(range(_ORDER + 1), range(_ORDER + 1))]
    determined = counted[:, 0] > _ORDER + 1
    normal[~determined] = np.eye(_ORDER + 1)
    curve = np.linalg.solve(normal, np.stack([weighted, np.eye(_ORDER + 1)[0] + 0 * weighted], -1))
    own = curve[:, 0, 1]  # weight of a reading in its curve, and the variance of that
    known = determined & (own < _MOST_OWN)
    left = np.where(known, 1 - own, np.nan)
    rate = np.where(known, curve[:, 1, 0] / (width * step_s), 0.0)
    off = (base - curve[:, 0, 0]) / left
    return _Beside(
        off=off,
        rate=rate,
        gain=1 / np.sqrt(left),
        moves=known & (np.abs(rate) > _MOVING * np.abs(rate).max()),
        rows=rows,
        step_s=step_s,
    )


def _scatter(told: Sequence[_Beside], units_s: Sequence[float]) -> tuple[list[Scatter], float]:
    """From medians in bins of the rate, variance = noise^2 + rate^2 jitter^2, against noise alone.

    Args:
      units_s: in which the jitter of each trial is the same.

    Returns: the scatter of each trial, and how certain its part in time is, sigma.
    """
    size = np.concatenate([np.abs(own.off[own.moves]) / own.gain[own.moves] for own in told])
    each = zip(told, units_s, strict=True)
    rate = np.concatenate([np.abs(own.rate[own.moves]) * unit_s for own, unit_s in each])
    bins = np.array_split(np.argsort(rate), _BINS)
    count = np.array([own.size for own in bins])
    squared = np.array([np.mean(rate[own] ** 2) for own in bins])
    variance = np.array([(np.median(size[own]) / _MAD) ** 2 for own in bins])
    alone = np.full(_BINS, np.average(variance, weights=count))
    slopes, both = np.stack([np.ones(_BINS), squared], axis=1), alone
    parts = np.zeros(2)
    for _ in range(_STEPS):
        weights = np.sqrt(count) / np.maximum(both, np.finfo(float).tiny)
        parts, _left = nnls(slopes * weights[:, None], variance * weights)
        both = slopes @ parts
    gained = _likelihood(variance, both, count) - _likelihood(variance, alone, count)
    noise, jitter = np.sqrt(parts)
    found = [Scatter(noise_deg=float(noise), jitter_s=float(jitter * unit_s)) for unit_s in units_s]
    return found, float(np.sqrt(max(2 * gained, 0.0)))


def _likelihood(variance: Array, model: Array, count: Array) -> float:
    model = np.maximum(model, np.finfo(float).tiny)
    return -float(np.sum(_EFFICIENCY * count * (np.log(model) + variance / model)))


def _alike(told: Sequence[_Beside]) -> float:
    """Correlation of the times by which samples are off with those of the next."""
    products, squares = 0.0, 0.0
    for own in told:
        most = _OUTLIER_SIGMA * np.median(np.abs(own.late_s)) / _MAD
        late = np.zeros(own.off.size)
        late[own.moves] = np.where(np.abs(own.late_s) < most, own.late_s, 0.0)  # without corners
        products += float(late[1:] @ late[:-1])
        squares += float(late @ late)
    return products / squares if squares > 0 else 0.0


def _beyond(told: Sequence[_Beside], scatters: Sequence[Scatter]) -> float:
    """Share of samples that neither scatter explains: where the curve, and not the time, is wrong."""
    each = zip(told, scatters, strict=True)
    far = [own.off**2 > _OUTLIER_SIGMA**2 * own.variance(scatter) for own, scatter in each]
    moving = np.concatenate([own.moves for own in told])
    return float(np.mean(np.concatenate(far)[moving]))


def _moved(trial: Trial, own: _Beside, scatter: Scatter) -> Trial:
    """A trial with its samples at the likeliest times, and examples of their errors."""
    stamps_s = trial["time_s"]
    taken_s = stamps_s + _late_s(_finer(trial[_BASE], own, scatter), scatter)
    motion = PchipInterpolator(taken_s, trial[_BASE])
    draws = np.random.default_rng(0).normal(size=(_EXAMPLES, 2, stamps_s.size))
    most_s = JITTER_MOST_STEPS * own.step_s
    late_s = np.clip(scatter.jitter_s * draws[:, 0], -most_s, most_s)
    base = motion(stamps_s + late_s) + scatter.noise_deg * draws[:, 1]
    found = np.stack([_late_s(_finer(each, own, scatter), scatter) for each in base])
    rows = FileRows(stamps_s=trial.file_rows.stamps_s, taken_s=taken_s, errors_s=found - late_s)
    return replace(trial, table=trial.table.assign(time_s=taken_s), rows=rows)


def _finer(base: Array, own: _Beside, scatter: Scatter) -> _Beside:
    """The readings beside a curve that follows corners."""
    curve = adaptive_curve(base, own.rows, own.step_s, scatter)
    left = 1 - curve.own_share
    return replace(
        own,
        off=(base - curve.angle_deg) / left,
        rate=np.nan_to_num(curve.rate_deg_s),
        gain=1 / np.sqrt(left),
    )


def _late_s(own: _Beside, scatter: Scatter) -> Array:
    """By how much samples are likely late, (N,).

    What is off by more than both scatters stays, and what noise tells more of than time.
    """
    variance = own.variance(scatter)
    known = np.isfinite(own.off) & (own.off**2 < _OUTLIER_SIGMA**2 * variance)
    known &= np.abs(own.rate) * scatter.jitter_s > scatter.noise_deg
    share = own.rate * scatter.jitter_s**2 / np.maximum(variance, np.finfo(float).tiny)
    late_s = np.where(known, share * np.nan_to_num(own.off), 0.0)
    return np.clip(late_s, -JITTER_MOST_STEPS * own.step_s, JITTER_MOST_STEPS * own.step_s)
