"""Tissue that changes in time, of which what less damping changes tells when.

It gives way, or grips, at an unknown time, and stays so in the trials that follow, or to the end of
that trial. It may also change between two trials: where the needle is inserted in another place. Its
torque is multiplied by a factor from then on. The starting value of the time is the one from which on
a multiple of the change takes most off the nominal residual,

    gain(t) = (sum of change * residual after t)^2 / sum of change^2 after t,  in units of the noise.

Or its torque, or dry friction beside it, swells and falls with a period, as tissue that breathes or
beats does, from a phase that is another one in each trial. The starting value of the period is the one
whose waves, times the change, take most off.
"""

from collections.abc import Sequence
from dataclasses import replace
from functools import partial

import numpy as np
from numpy.typing import NDArray

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.freeform.families.in_time.events import (
    DIFFERENCES,
    Moment,
    around,
    change_between,
    curves_of,
    times_of,
    trials_after,
)
from diagnosis.freeform.family import Family, Points, coordinates
from diagnosis.freeform.ranges import LogRanges
from diagnosis.log.trial import SENSORS
from diagnosis.replay.curve import ActsOn, Curve
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.replay.variables import Variable
from models.tissue import Interface

Array = NDArray[np.float64]

_EITHER = {Place.TISSUE: 0.6, Place.INTERFACE: 0.4}
_LEAST_S = 1.0  # from either end of a trial
_LEAST_WAVES, _FASTEST_HZ = 3.0, 2.0  # in the longest trial; hearts beat twice a second
_WAVE_PLACES, _SWELLS = 12, 0.3
_START, _LEAST, _MOST = (0.6, 1.6), 0.01, 100.0  # factor
_LONGEST_S = 5.0  # that it takes to change


def families(ranges: LogRanges) -> tuple[Family, ...]:
    """All changes, if the log is long enough and less damping was simulated."""
    if not ranges.softer:
        return ()
    found = []
    for stays in (True, False):
        if moment := largest_change(ranges, stays=stays):
            found.append(_gives_way(moment, trials_after(ranges, moment) if stays else ()))
    distinct = {family.name: family for family in reversed(found)}  # nothing follows the last trial
    rate_hz = strongest_wave_hz(ranges)
    breathes = (_breathes(ranges, rate_hz), _pulses(ranges, rate_hz)) if rate_hz else ()
    return (*reversed(distinct.values()), *breathes)


def largest_change(ranges: LogRanges, *, stays: bool = True) -> Moment | None:
    """From when on a changed damping takes most off the nominal residual; None: trials are too short.

    Args:
      stays: whether it is changed in the trials that follow, too.
    """
    best, found, along, size = 0.0, None, 0.0, 0.0
    trials = ranges.problem.log.trials
    for number in reversed(range(len(trials))):
        time_s, product, square = _in_time(ranges, number)
        after = along + np.cumsum(product[::-1])[::-1]
        squares = size + np.cumsum(square[::-1])[::-1]
        gain = np.where(squares > 0, after**2 / np.maximum(squares, 1e-300), 0.0)
        inside = (time_s > _LEAST_S) & (time_s < time_s[-1] - _LEAST_S) if time_s.size else []
        if time_s.size and number > 0 and stays:
            inside[0] = True  # between two trials
        gain = np.where(inside, gain, 0.0)
        if gain.size and gain.max() > best:
            at = int(np.argmax(gain))
            best, found = float(gain[at]), Moment(trial=trials[number].name, time_s=float(time_s[at]))
        if stays:
            along, size = along + float(product.sum()), size + float(square.sum())
    return found


def _in_time(ranges: LogRanges, number: int) -> tuple[Array, Array, Array]:
    """Of a trial, in the order of time: s after its start, change * residual, and change^2."""
    problem = ranges.problem
    trial, each = problem.log.trials[number], [np.zeros((3, 0))]  # where nothing was read
    for sensor in filter(trial.has, SENSORS):
        nominal, noise = ranges.nominal[number][sensor], problem.noise[sensor]
        change = (ranges.softer[number][sensor] - nominal) / noise
        left = (trial.readings[sensor] - nominal) / noise
        read = np.isfinite(left)
        after_s = trial.time_s[read] - trial.time_s[0]
        each.append(np.stack([after_s, (change * left)[read], (change**2)[read]]))
    rows = np.concatenate(each, axis=1)
    time_s, product, square = rows[:, np.argsort(rows[0], kind="stable")]
    return time_s, product, square


def _gives_way(moment: Moment, after: tuple[str, ...]) -> Family:
    """The change; in trials `after` it, it stays."""
    how, where = ("for good", f"from {moment.trial} on") if after else ("once", f"in {moment.trial}")
    when, lasting = (replace(p, start=2 * p.start) for p in times_of(moment))
    lasting = replace(lasting, high=_LONGEST_S)
    factor = Parameter(
        name="factor", unit="-", low=_LEAST, high=_MOST, start=_START, logarithmic=True, neutral=1.0
    )
    return Family(
        effect=Effect(
            name=f"tissue that gives way, {how}",
            title=f"tissue that gives way or grips, {how}, {where}",
            place=Place.TISSUE,
            parameters=(when, lasting, factor),
            apply=partial(_apply, moment.trial, after),
            differences=DIFFERENCES,
            trial="" if after else moment.trial,
        ),
        places=_EITHER,
        says="event",
        title=f"torque of the tissue {where}",
        curve=_changes,
        x_unit="s",
        unit="-",
    )


def _changes(time_s: float, duration_s: float, factor: float) -> Points:
    return change_between(time_s, duration_s, 1.0, factor)


def _apply(
    trial: str,
    after: tuple[str, ...],
    rig: RigParameters,
    time_s: float,
    duration_s: float,
    factor: float,
) -> RigParameters:
    curves = curves_of(ActsOn.TISSUE, trial, after, around(time_s, duration_s), (1.0, factor))
    return replace(rig, free=FreeLaw(tissue_varies=True, curves=curves))


def strongest_wave_hz(ranges: LogRanges) -> float:
    """Waves per second, times what less damping changes, that take most off; 0: trials are too short."""
    longest_s = max(float(t.time_s[-1] - t.time_s[0]) for t in ranges.problem.log.trials)
    rates = np.arange(_LEAST_WAVES / longest_s, _FASTEST_HZ, 0.5 / longest_s)
    taken = np.zeros(rates.size)
    for number in range(len(ranges.problem.log.trials)):
        time_s, product, square = _in_time(ranges, number)
        taken += [_taken_off(2 * np.pi * rate * time_s, product, square) for rate in rates]
    return float(rates[np.argmax(taken)]) if taken.any() else 0.0


def _taken_off(phase: Array, product: Array, square: Array) -> float:
    """By a wave with a phase of its own, by linear least squares."""
    waves = np.stack([np.cos(phase), np.sin(phase)])
    right = waves @ product
    return float(right @ np.linalg.pinv((waves * square) @ waves.T) @ right)


def _breathes(ranges: LogRanges, rate_hz: float) -> Family:
    trials = tuple(trial.name for trial in ranges.problem.log.trials)
    return Family(
        effect=Effect(
            name="damping over time, as a wave",
            title="damping that swells and falls with a period",
            place=Place.TISSUE,
            parameters=(_period(rate_hz), *coordinates(0, 2 * len(trials), _SWELLS)),
            apply=partial(_apply_breathing, trials),
        ),
        places=_EITHER,
        says="time",
        title=f"damping along the shaft in {trials[0]}",
        curve=partial(_breath, ranges.damping_n_mm_s_per_mm),
        x_unit="s",
        unit="N mm s / rad / mm",
    )


def _pulses(ranges: LogRanges, rate_hz: float) -> Family:
    trials = tuple(trial.name for trial in ranges.problem.log.trials)
    level = ranges.library["coulomb_friction"].parameters[0]
    shape = (_period(rate_hz), *coordinates(0, 2 * len(trials)))
    return Family(
        effect=Effect(
            name="dry friction over time, as a wave",
            title="dry friction that swells and falls with a period",
            place=Place.TISSUE,
            parameters=(level, *(replace(p, start=p.start * len(level.start)) for p in shape)),
            apply=partial(_apply_pulses, trials),
            differences=(1e-2,),
        ),
        places=_EITHER,
        says="time",
        title=f"dry friction along the shaft in {trials[0]}",
        curve=_breath,
        x_unit="s",
        unit="N mm / mm",
    )


def _period(rate_hz: float) -> Parameter:
    """Near where waves take most off."""
    return Parameter(
        name="period",
        unit="s",
        low=0.9 / rate_hz,
        high=1.1 / rate_hz,
        start=(1.0 / rate_hz,),
        logarithmic=True,
        neutral=None,
    )


def _wave(shares: Array, cosine: float, sine: float) -> Array:
    """Factors at shares of a period."""
    phase = 2 * np.pi * shares
    return np.asarray(np.exp(cosine * np.cos(phase) + sine * np.sin(phase)))


def _breath(beta: float, period_s: float, *c: float) -> Points:
    shares = np.linspace(0.0, 1.0, _WAVE_PLACES + 1)
    return period_s * shares, beta * _wave(shares, *c[:2])


def _apply_breathing(
    trials: tuple[str, ...], rig: RigParameters, period_s: float, *c: float
) -> RigParameters:
    return replace(rig, free=FreeLaw(tissue_varies=True, curves=_waves(trials, period_s, c)))


def _apply_pulses(
    trials: tuple[str, ...], rig: RigParameters, level: float, period_s: float, *c: float
) -> RigParameters:
    law = Interface(kinetic_n_mm_per_mm=level, varies=True)
    return replace(rig, free=FreeLaw(throughout=(law,), curves=_waves(trials, period_s, c)))


def _waves(trials: tuple[str, ...], period_s: float, c: Sequence[float]) -> tuple[Curve, ...]:
    """Of each trial, factors over the time."""
    shares = np.arange(_WAVE_PLACES) / _WAVE_PLACES
    return tuple(
        Curve(
            acts_on=ActsOn.TISSUE,
            variable=Variable.TIME,
            places=tuple(float(x) for x in period_s * shares),
            values=tuple(float(v) for v in _wave(shares, *own)),
            period=period_s,
            trial=name,
        )
        for name, own in zip(trials, zip(c[::2], c[1::2], strict=True), strict=True)
    )
