"""Readings that were smoothed after recording, forwards and backwards: without delay, as many logs are.

A filter, Savgol's or a moving mean takes the fast part of the noise away, and rounds the corners of the
signal. Readings with white noise of standard deviation s, in rows dt apart, and a motion whose spectrum
falls by the power p have the spectrum

    S(f) = 2 s^2 dt (1 + (f1 / f)^p) |H(f)|^2

Spectra over cycles per row compare among trials at one rate alone: of others nothing is asked. A
Butterworth filter of order n that was run twice has

    |H|^2 = 1 / (1 + (tan(pi f dt) / tan(pi f0 dt))^2n)^2

f1, p, f0 and n are fitted. Others have zeros, between lobes. One of both has to be seen far below the
level 2 s^2 dt of the claimed noise, which unfiltered readings reach at every frequency. Correlated noise
falls by f^-2 alone, and motion without noise as behind a filter of first order.
"""

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import least_squares
from scipy.signal import welch

from diagnosis.criteria.faults import (
    SMOOTHED_LEAST_ORDER,
    SMOOTHED_LEVEL,
    SMOOTHED_MISFIT,
    SMOOTHED_OVER_ROUNDING,
    SMOOTHED_SEGMENTS,
    SMOOTHED_ZERO,
    SMOOTHED_ZERO_LEVEL,
)
from diagnosis.criteria.log import FEWEST_ROWS
from diagnosis.log.faults.scatter import quantum
from diagnosis.log.trial import SENSORS, Trial, sampled_at

Array = NDArray[np.float64]

_SEGMENT_S = 2.5
_LOWEST, _HIGHEST = 1e-6, 1e3  # levels that are looked at
_SCATTER = 0.3  # of their logarithms
_ORDERS = (2.0, 4.0)  # from which a fit begins
_NARROW = 4  # a zero rises within a quarter of its frequency
_HALF = 0.5  # of the power: at the corner of a filter
_CORNER_OF_MEANS = 0.443  # in that of its first zero: sin^2(x) / x^2 = 1/2


def smoothed_above_hz(
    trials: Sequence[Trial], noise: Mapping[str, float]
) -> tuple[dict[str, float], list[str]]:
    """The corner, Hz, of the filter by which readings were smoothed, by sensor, and a warning for each.

    Args:
      noise: claimed standard deviation by column.
    """
    each = {sensor: _corner_hz(trials, sensor, noise.get(sensor, 0.0)) for sensor in SENSORS}
    found = {sensor: corner_hz for sensor, corner_hz in each.items() if corner_hz is not None}
    return found, [_told(sensor, corner_hz) for sensor, corner_hz in found.items()]


def _corner_hz(trials: Sequence[Trial], sensor: str, claim: float) -> float | None:
    """The corner of a filter, Hz; None: there was none."""
    runs = [(trial, _longest_run(trial[sensor])) for trial in trials if trial.has(sensor)]
    read = [(trial, rows) for trial, rows in runs if rows.stop - rows.start >= FEWEST_ROWS]
    if not claim > 0 or not read:
        return None
    step_s = float(np.median(np.concatenate([np.diff(trial["time_s"][rows]) for trial, rows in read])))
    own = [trial[sensor][rows] for trial, rows in read if sampled_at(trial["time_s"][rows], step_s)]
    segment = min(round(_SEGMENT_S / step_s), sum(values.size for values in own) // SMOOTHED_SEGMENTS)
    if segment < FEWEST_ROWS:
        return None
    frequency, levels = _levels(own, claim, segment)
    rounding = float(np.mean([quantum(values) ** 2 for values in own])) / 12 / claim**2
    corner = _below_first_zero(frequency, levels) or _of_butterworth(frequency, levels, rounding)
    return corner / step_s if corner else None


def _below_first_zero(frequency: Array, levels: Array) -> float | None:
    """Corner of a mean over rows, one of whose zeros is clear; None: none is.

    The first of them may be filled by the motion in part.
    """
    zeros = [k for k in map(int, np.flatnonzero(levels < _HALF)) if _is_zero(levels, k)]
    if not zeros or levels[zeros].min() > SMOOTHED_ZERO_LEVEL:
        return None
    return float(_CORNER_OF_MEANS * frequency[zeros[0]])


def _is_zero(levels: Array, k: int) -> bool:
    """Whether a spectrum rises on both sides of a frequency."""
    beside = max(2, k // _NARROW)
    sides = levels[max(k - beside, 0) : k], levels[k + 1 : k + 1 + beside]
    return all(side.size > 0 and np.median(side) > SMOOTHED_ZERO * levels[k] for side in sides)


def _of_butterworth(frequency: Array, levels: Array, rounding: float) -> float | None:
    """Corner of a Butterworth filter that was run twice; None: the spectrum is not one behind that.

    Args:
      rounding: level of that of the readings.
    """
    least = max(SMOOTHED_OVER_ROUNDING * rounding, _LOWEST)
    told = (levels > least) & (levels < _HIGHEST)
    if not (levels[told] < SMOOTHED_LEVEL).any():
        return None
    warped, own = np.log(np.tan(np.pi * frequency[told])), np.log(levels[told])
    fits = [_fitted(warped, own, order) for order in _ORDERS]
    (_, _, corner, order), off = min(fits, key=lambda fit: float(np.abs(fit[1]).mean()))
    if order < SMOOTHED_LEAST_ORDER or np.abs(off[own < np.log(_HALF)]).mean() > SMOOTHED_MISFIT:
        return None
    half = corner + np.log(np.sqrt(2.0) - 1.0) / (2.0 * order)
    return float(np.arctan(np.exp(half)) / np.pi)


def _fitted(warped: Array, logs: Array, order: float) -> tuple[Array, Array]:
    """Level of the motion at the corner, power, corner and order that fit, and how far off levels are.

    Args:
      warped: logarithms of tan(pi f dt), as is the corner; (F,).
      logs: those of levels, (F,).
      order: from which to begin.
    """

    def off(shape: Array) -> Array:
        motion, falls, corner, order = shape
        signal = np.logaddexp(0.0, motion - falls * (warped - corner))
        return np.asarray(signal - 2.0 * np.logaddexp(0.0, 2.0 * order * (warped - corner)) - logs)

    below = warped[logs < np.log(_HALF)]
    low, high = (-20.0, 1.0, warped[0], 1.0), (30.0, 8.0, warped[-1], 12.0)
    begun = np.clip((2.0, 4.0, below[0], order), low, high)
    fit = least_squares(off, begun, bounds=(low, high), loss="soft_l1", f_scale=_SCATTER)
    return np.asarray(fit.x), np.asarray(fit.fun)


def _levels(read: Sequence[Array], claim: float, segment: int) -> tuple[Array, Array]:
    """Frequencies, in cycles per row, and spectral densities in that of the claim; (F,) each.

    Second differences, whose spectrum is divided by theirs, keep slow motion out of fast frequencies. Of
    all trials the largest counts: who smooths a sensor does it in each.

    Args:
      segment: rows over which they are averaged at most.
    """
    rows = [values.size - 2 for values in read]
    spectra = [welch(np.diff(values, 2), nperseg=min(segment, *rows)) for values in read]
    frequency = spectra[0][0][1:]
    density = np.max([own[1:] for _, own in spectra], axis=0)
    return frequency, density / (2 * np.sin(np.pi * frequency)) ** 4 / (2 * claim**2)


def _longest_run(values: Array) -> slice:
    """The longest run of readings."""
    read = np.concatenate(([False], np.isfinite(values), [False])).astype(np.int8)
    first, last = np.flatnonzero(np.diff(read)).reshape(-1, 2).T
    if not first.size:
        return slice(0, 0)
    longest = int(np.argmax(last - first))
    return slice(int(first[longest]), int(last[longest]))


def _told(sensor: str, corner_hz: float) -> str:
    return (
        f"{sensor} was smoothed after recording: of its noise little is left above {corner_hz:.2g} Hz; "
        "it is compared with predictions below that, which tells less; log it without the filter"
    )
