"""Tissue that changes or turns with a period, as one that breathes or beats.

Its torque, or dry friction beside it, swells and falls, or it turns to and fro and takes the needle
with it, from a phase that is another one in each trial. With a the complex amplitude of a trial, whose
size and phase are open, and b that of the second harmonic, which all trials share,

    wave = Re[a* e^(i phi) + b a*^2 / |a| e^(2 i phi)],    phi = 2 pi t / period.

The starting value of the period is the one
whose waves, times what less damping or another angle of the tip would change, take most off.
"""

from collections.abc import Sequence
from dataclasses import replace
from functools import partial

import numpy as np
from numpy.typing import NDArray

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.freeform.families.in_time.changes import in_time
from diagnosis.freeform.family import VISCOUS, Family, Points, coordinates, of_trials
from diagnosis.freeform.ranges import LogRanges
from diagnosis.log.trial import TIP
from diagnosis.replay.curve import FACTORS, ActsOn, Curve
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.replay.variables import Variable
from models.tissue import Interface

Array = NDArray[np.float64]

_EITHER = {Place.TISSUE: 0.6, Place.INTERFACE: 0.4}
_LEAST_WAVES, _FASTEST_HZ = 3.0, 2.0  # in the longest trial; hearts beat twice a second
_WAVE_PLACES, _SWELLS = 16, 0.3
_NONE = 1e-12  # of an amplitude
_SECOND = coordinates(2, 0)  # real and imaginary part of the second harmonic


def families(ranges: LogRanges) -> tuple[Family, ...]:
    """All waves, if trials are long enough and less damping was simulated (`in_time` asks for it)."""
    if not ranges.softer:
        return ()
    found: list[Family] = []
    if rate_hz := strongest_wave_hz(ranges):
        found += [_breathes(ranges, rate_hz), _pulses(ranges, rate_hz)]
    if TIP in ranges.missing and (rate_hz := strongest_wave_hz(ranges, of_damping=False)):
        found.append(_turns(ranges, rate_hz))
    return tuple(found)


def strongest_wave_hz(ranges: LogRanges, *, of_damping: bool = True) -> float:
    """Waves per second that take most off; 0: trials are too short.

    Args:
      of_damping: whether they are times what less damping changes; else they are of the tip's angle.
    """
    longest_s = max(float(t.time_s[-1] - t.time_s[0]) for t in ranges.problem.log.trials)
    rates = np.arange(_LEAST_WAVES / longest_s, _FASTEST_HZ, 0.5 / longest_s)
    taken = np.zeros(rates.size)
    for number in range(len(ranges.problem.log.trials)):
        time_s, product, square = in_time(ranges, number, of_damping=of_damping)
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
            parameters=(_period(rate_hz), *_SECOND, *of_trials(2 * len(trials), _SWELLS)),
            apply=partial(_apply_breathing, trials),
        ),
        places=_EITHER,
        says="time",
        title=f"damping along the shaft in {trials[0]}",
        curve=partial(_breath, ranges.damping_n_mm_s_per_mm),
        x_unit="s",
        unit=VISCOUS,
    )


def _pulses(ranges: LogRanges, rate_hz: float) -> Family:
    trials = tuple(trial.name for trial in ranges.problem.log.trials)
    level = ranges.dry_level
    shape = (_period(rate_hz), *_SECOND, *of_trials(2 * len(trials)))
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


def _turns(ranges: LogRanges, rate_hz: float) -> Family:
    """The tissue turns to and fro, and takes the needle with it."""
    trials = tuple(trial.name for trial in ranges.problem.log.trials)
    return Family(
        effect=Effect(
            name="tissue angle over time, as a wave",
            title="tissue that turns to and fro with a period",
            place=Place.TISSUE,
            parameters=(_period(rate_hz), *_SECOND, *of_trials(2 * len(trials), ranges.missing[TIP])),
            apply=partial(_apply_turning, trials),
        ),
        places={Place.TISSUE: 1.0},
        says="time",
        title=f"angle by which the tissue turns in {trials[0]}",
        curve=_to_and_fro,
        x_unit="s",
        unit="deg",
    )


def _to_and_fro(period_s: float, *c: float) -> Points:
    shares = np.linspace(0.0, 1.0, _WAVE_PLACES + 1)
    return period_s * shares, _wave(shares, c[:2], c[2:4])


def _apply_turning(
    trials: tuple[str, ...], rig: RigParameters, period_s: float, *c: float
) -> RigParameters:
    return replace(rig, free=FreeLaw(curves=_waves(ActsOn.TISSUE_ANGLE, trials, period_s, c)))


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


def _wave(shares: Array, second: Sequence[float], own: Sequence[float]) -> Array:
    """A wave at shares of its period.

    Args:
      second: real and imaginary part of b.
      own: of a trial, real and imaginary part of a.
    """
    turn, first = np.exp(2j * np.pi * shares), complex(own[0], -own[1])
    twice = complex(*second) * first**2 / max(abs(first), _NONE)
    return np.asarray((first * turn + twice * turn**2).real)


def _breath(beta: float, period_s: float, *c: float) -> Points:
    shares = np.linspace(0.0, 1.0, _WAVE_PLACES + 1)
    return period_s * shares, beta * np.exp(_wave(shares, c[:2], c[2:4]))


def _apply_breathing(
    trials: tuple[str, ...], rig: RigParameters, period_s: float, *c: float
) -> RigParameters:
    return replace(
        rig, free=FreeLaw(tissue_varies=True, curves=_waves(ActsOn.TISSUE, trials, period_s, c))
    )


def _apply_pulses(
    trials: tuple[str, ...], rig: RigParameters, level: float, period_s: float, *c: float
) -> RigParameters:
    law = Interface(kinetic_n_mm_per_mm=level, varies=True)
    curves = _waves(ActsOn.TISSUE, trials, period_s, c)
    return replace(rig, free=FreeLaw(throughout=(law,), curves=curves))


def _waves(
    acts_on: ActsOn, trials: tuple[str, ...], period_s: float, c: Sequence[float]
) -> tuple[Curve, ...]:
    """Of each trial, a wave over the time; of factors, one of their logarithms."""
    shares = np.arange(_WAVE_PLACES) / _WAVE_PLACES
    waves = [_wave(shares, c[:2], own) for own in zip(c[2::2], c[3::2], strict=True)]
    return tuple(
        Curve(
            acts_on=acts_on,
            variable=Variable.TIME,
            places=tuple(float(x) for x in period_s * shares),
            values=tuple(float(v) for v in (np.exp(wave) if acts_on in FACTORS else wave)),
            period=period_s,
            trial=name,
        )
        for name, wave in zip(trials, waves, strict=True)
    )
