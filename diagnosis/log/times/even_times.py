"""Jitter of time stamps: samples that were taken evenly, but stamped later by a computer.

In a turn of 200 deg/s a stamp that is 1 ms late means an error of 0.2 deg, ten times the noise
of an encoder. If samples were taken evenly, row i was taken at

    t_i = t_0 + h k_i,  k_i increasing integers, with steps above one where rows were lost

and its stamp is t_i plus an error. h is the period for which the stamps are most in phase, |sum
exp(2 pi i t / h)|; k_i - i never falls, so it is the rounded isotonic regression of t_i / h - i.

Samples may also have been taken unevenly and stamped correctly. The data decide: readings of a fast
motion are smooth over the true times. On both time axes each reading is compared with a
cubic through its neighbours; if one axis gives the smaller difference so often that chance is excluded,
it is the true one. Samples whose difference could be noise are not used.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import isotonic_regression

from diagnosis.criteria.log import EVEN_MOST_STEPS, EVEN_SIGMA, EVEN_TELLING_SIGMA, FEWEST_ROWS
from diagnosis.log.local_curves import interpolated
from diagnosis.log.trial import SENSORS, FileRows, Trial

Array = NDArray[np.float64]
Counts = NDArray[np.intp]
Mask = NDArray[np.bool_]

_BASE = "base_angle_deg"
_SEARCHED = 0.25  # of the median step, either way, that the period is searched in
_FIRST = 600  # stamps that the period is searched in
_PAUSE_STEPS = 10.0
_FINER = 8  # periods to try per resolvable one
_REFINEMENTS = 4


def with_even_times(trials: Sequence[Trial]) -> tuple[list[Trial], list[str]]:
    """The trials with even times, if stamps scatter about such and the motion confirms it; warnings.

    Stamps that have lost count of their steps stay.
    """
    guesses = [max(_even_times(t["time_s"]), key=lambda at: _certainty([t], [at])) for t in trials]
    evens = [at if _counted(t["time_s"], at) else None for t, at in zip(trials, guesses, strict=True)]
    told = [(t, at) for t, at in zip(trials, evens, strict=True) if at is not None]
    if not told or _certainty(*zip(*told, strict=True)) < EVEN_SIGMA:
        return list(trials), []
    scatter_s, step_s = max((_rms(t["time_s"] - at), _step_s(at)) for t, at in told)
    said = (
        f"time_s scatters by {1e3 * scatter_s:.2g} ms about steps of {1e3 * step_s:.4g} ms, over "
        "which the motion is smooth: the samples are taken to be even; stamp them where they are taken"
    )
    pairs = zip(trials, evens, strict=True)
    return [trial if at is None else _over(trial, at) for trial, at in pairs], [said]


def _counted(stamps_s: Array, even_s: Array) -> bool:
    """Whether stamps scatter by so little about even times that no count of them is lost."""
    return _rms(stamps_s - even_s) <= EVEN_MOST_STEPS * _step_s(even_s)


def _step_s(even_s: Array) -> float:
    return float(np.diff(even_s).min())


def _over(trial: Trial, even_s: Array) -> Trial:
    rows = FileRows(stamps_s=trial["time_s"], taken_s=even_s)
    return replace(trial, table=trial.table.assign(time_s=even_s), rows=rows)


def _rms(values: Array) -> float:
    return float(np.sqrt(np.mean(values**2)))


def _even_times(stamps_s: Array) -> tuple[Array, Array]:
    """Times of evenly taken samples, s, if no row was lost, and if some were; (N,) each."""
    index = np.arange(stamps_s.size, dtype=np.intp)
    return _on_line(stamps_s, index), _on_line(stamps_s, _counts(stamps_s))


def _on_line(stamps_s: Array, counts: Counts) -> Array:
    start, period = np.polynomial.polynomial.polyfit(counts, stamps_s, 1)
    return np.asarray(start + period * counts)


def _counts(stamps_s: Array) -> Counts:
    """The index of each sample on an even grid, lost rows included, (N,)."""
    index = np.arange(stamps_s.size, dtype=np.intp)
    period, start, counts = _period(stamps_s), stamps_s[0], index
    for _ in range(_REFINEMENTS):
        ahead = isotonic_regression((stamps_s - start) / period - index).x
        counts = index + np.rint(ahead).astype(int)
        start, period = np.polynomial.polynomial.polyfit(counts, stamps_s, 1)
    return np.asarray(counts, np.intp)


def _period(stamps_s: Array) -> float:
    """The period for which stamps are most in phase, near their median step, s.

    It is that of their longest stretch without a pause, since a pause loses the phase.
    """
    first = stamps_s[:_FIRST]
    step = float(np.median(np.diff(first)))
    pauses = np.flatnonzero(np.diff(first) > _PAUSE_STEPS * step) + 1
    stretch = max(np.split(first, pauses), key=len)
    stamps = stretch - stretch[0]
    count = max(2, round(_FINER * 2 * _SEARCHED * stamps[-1] / step))
    rates = np.linspace(1 - _SEARCHED, 1 + _SEARCHED, count) / step
    together = np.abs(np.exp(2j * np.pi * rates[:, None] * stamps).sum(axis=1))
    return float(1 / rates[np.argmax(together)])


def _certainty(trials: Sequence[Trial], evens: Sequence[Array]) -> float:
    """Significance with which readings are smoother over even times than over stamps, in sigma."""
    wins = np.concatenate(
        [
            _nearer(trial[name], trial["time_s"], even_s)
            for trial, even_s in zip(trials, evens, strict=True)
            for name in (_BASE, *SENSORS)
            if trial.has(name)
        ]
    )
    return float((2 * wins.sum() - wins.size) / np.sqrt(max(wins.size, 1)))


def _nearer(values: Array, stamps_s: Array, even_s: Array) -> Mask:
    """Whether samples, where noise cannot decide, are nearer to a cubic over even times, (M,)."""
    rows = np.flatnonzero(np.isfinite(values))
    if rows.size < FEWEST_ROWS:
        return np.zeros(0, bool)
    read = values[rows]
    (there, loud), (here, quiet) = (interpolated(at[rows], read, 1, 2) for at in (stamps_s, even_s))
    off_there, off_here = np.abs(read - there), np.abs(read - here)
    # Of a normal distribution, the median size is 0.67 sigma.
    sigma = min(np.nanmedian(off_there / loud), np.nanmedian(off_here / quiet)) / 0.6745
    telling = np.abs(there - here) > EVEN_TELLING_SIGMA * sigma * np.maximum(loud, quiet)
    return np.asarray(off_here[telling] < off_there[telling])
