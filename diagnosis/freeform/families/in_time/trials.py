"""What is another one in each trial: a sensor zeroed anew, a needle inserted in another place.

- damping, dry friction beside it, or the stiffness of the shaft, times a factor of each trial
- a length by which more of the shaft is inserted in it than was logged
- an offset, or a gain, of the tip or torque sensor in it, or a drift of its own from zero

No other trial tells of the number of a trial that is left out of a fit: it stays as fitted. So such a
law is judged by the trials of its fit, and by how many numbers it takes.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from diagnosis.effects.effect import Effect, Place
from diagnosis.freeform.families.readings import SENSOR
from diagnosis.freeform.family import (
    TRIALS,
    VISCOUS,
    Family,
    Points,
    from_neutral,
    most_probable,
    of_trials,
)
from diagnosis.freeform.ranges import LogRanges
from diagnosis.log.trial import TIP, TORQUE
from diagnosis.replay.curve import FACTORS, ActsOn, Curve
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.replay.variables import Variable
from models.tissue import Interface

FEWEST_TRIALS = 2
_DRIFTS = (ActsOn.TIP_READING, ActsOn.TORQUE_READING)
_FACTOR, _LENGTH_MM = 0.3, 5.0  # sizes to look for: of the logarithm, and of a length
_TISSUE = {Place.TISSUE: 0.5, Place.INTERFACE: 0.3, Place.PARAMETERS: 0.2}
_SHAFT = {Place.PARAMETERS: 0.6, Place.NEEDLE: 0.4}


@dataclass(frozen=True, kw_only=True, eq=False)
class _Quantity:
    """What has a number of its own in each trial.

    Attributes:
      words: what it is, in plain words.
      scale: of its coordinates, in its unit or in the logarithm of a factor.
      at_factor_one: its value in its unit where its factor is 1.
      varies: whether the torque of the nominal tissue follows.
    """

    acts_on: ActsOn
    words: str
    places: dict[Place, float]
    unit: str
    scale: float
    at_factor_one: float = 1.0
    varies: bool = False


def families(ranges: LogRanges) -> tuple[Family, ...]:
    """All of them, if there are enough trials."""
    trials = tuple(trial.name for trial in ranges.problem.log.trials)
    if len(trials) < FEWEST_TRIALS:
        return ()
    own = [_of_each_trial(quantity, trials) for quantity in _quantities(ranges)]
    drifts = [_drift(q, trials) for q in _quantities(ranges) if q.acts_on in _DRIFTS]
    return (*own, *drifts, _friction(ranges, trials))


def _quantities(ranges: LogRanges) -> list[_Quantity]:
    beta, unit = ranges.damping_n_mm_s_per_mm, VISCOUS
    needle = [
        _Quantity(
            acts_on=ActsOn.TISSUE,
            words="damping along the shaft",
            places=_TISSUE,
            unit=unit,
            scale=_FACTOR,
            at_factor_one=beta,
            varies=True,
        ),
        _Quantity(
            acts_on=ActsOn.STIFFNESS,
            words="stiffness of the shaft over the nominal",
            places=_SHAFT,
            unit="-",
            scale=_FACTOR,
            varies=True,
        ),
        _Quantity(
            acts_on=ActsOn.INSERTED_LENGTH,
            words="true inserted length less the logged one",
            places={Place.PARAMETERS: 1.0},
            unit="mm",
            scale=_LENGTH_MM,
        ),
    ]
    read = {
        TIP: (ActsOn.TIP_READING, ActsOn.TIP_GAIN, "tip", "deg"),
        TORQUE: (ActsOn.TORQUE_READING, ActsOn.TORQUE_GAIN, "torque", "N mm"),
    }
    for sensor, (added, gain, what, own) in read.items():
        if sensor in ranges.missing:
            offset = max(ranges.missing[sensor], ranges.problem.noise[sensor])
            needle += [
                _sensor(added, f"offset of the {what} sensor", own, offset),
                _sensor(gain, f"gain of the {what} sensor", "-", _FACTOR),
            ]
    return needle


def _sensor(acts_on: ActsOn, words: str, unit: str, scale: float) -> _Quantity:
    return _Quantity(acts_on=acts_on, words=words, places=SENSOR, unit=unit, scale=scale)


def _of_each_trial(quantity: _Quantity, trials: Sequence[str]) -> Family:
    return Family(
        effect=Effect(
            name=f"{quantity.acts_on.replace('_', ' ')} over time, of each trial",
            title=f"{quantity.words}, another one in each trial",
            place=most_probable(quantity.places),
            parameters=of_trials(len(trials), quantity.scale),
            apply=partial(_apply, quantity, trials),
        ),
        places=quantity.places,
        says="time",
        title=f"{quantity.words}, trial by trial",
        curve=partial(_points, quantity),
        x_unit=TRIALS,
        unit=quantity.unit,
    )


def _values(quantity: _Quantity, c: Sequence[float]) -> list[float]:
    return [float(np.exp(own)) if quantity.acts_on in FACTORS else own for own in c]


def _points(quantity: _Quantity, *c: float) -> Points:
    own = np.array(_values(quantity, c))
    return np.arange(1, len(c) + 1), quantity.at_factor_one * own


def _curves(acts_on: ActsOn, trials: Sequence[str], values: Sequence[float]) -> tuple[Curve, ...]:
    of_time = partial(Curve, acts_on=acts_on, variable=Variable.TIME, places=(0.0, 1.0))
    each = zip(trials, values, strict=True)
    return tuple(of_time(values=(value, value), trial=name) for name, value in each)


def _apply(quantity: _Quantity, trials: Sequence[str], rig: RigParameters, *c: float) -> RigParameters:
    curves = _curves(quantity.acts_on, trials, _values(quantity, c))
    return replace(rig, free=FreeLaw(tissue_varies=quantity.varies, curves=curves))


def _drift(quantity: _Quantity, trials: Sequence[str]) -> Family:
    """What a sensor is off by in the middle and at the end of each trial, of which it begins at zero."""
    words = quantity.words.replace("offset", "drift")
    return Family(
        effect=Effect(
            name=f"{quantity.acts_on.replace('_', ' ')} over time, drifting in each trial",
            title=f"{words}, another one in each trial",
            place=Place.SENSOR,
            parameters=of_trials(2 * len(trials), quantity.scale),
            apply=partial(_apply_drift, quantity.acts_on, trials),
        ),
        places=quantity.places,
        says="time",
        title=f"{words} at the end of each trial",
        curve=_ends_of_drifts,
        x_unit=TRIALS,
        unit=quantity.unit,
    )


def _ends_of_drifts(*c: float) -> Points:
    return np.arange(1, len(c) // 2 + 1), np.array(c[1::2])


def _apply_drift(acts_on: ActsOn, trials: Sequence[str], rig: RigParameters, *c: float) -> RigParameters:
    of_share = partial(Curve, acts_on=acts_on, variable=Variable.TRIAL_SHARE, places=(0.0, 0.5, 1.0))
    each = zip(trials, c[::2], c[1::2], strict=True)
    curves = tuple(of_share(values=(0.0, middle, end), trial=name) for name, middle, end in each)
    return replace(rig, free=FreeLaw(curves=curves))


def _friction(ranges: LogRanges, trials: Sequence[str]) -> Family:
    level = ranges.dry_level
    own = from_neutral(of_trials(len(trials)), level)
    return Family(
        effect=Effect(
            name="dry friction over time, of each trial",
            title="dry friction along the shaft, another one in each trial",
            place=Place.INTERFACE,
            parameters=(level, *own),
            apply=partial(_apply_friction, trials),
            differences=(1e-2,),
        ),
        places={Place.INTERFACE: 0.6, Place.TISSUE: 0.4},
        says="time",
        title="dry friction along the shaft, trial by trial",
        curve=_levels,
        x_unit=TRIALS,
        unit="N mm / mm",
    )


def _levels(level: float, *c: float) -> Points:
    return np.arange(1, len(c) + 1), level * np.exp(np.array(c))


def _apply_friction(trials: Sequence[str], rig: RigParameters, level: float, *c: float) -> RigParameters:
    law = Interface(kinetic_n_mm_per_mm=level, varies=True)
    curves = _curves(ActsOn.TISSUE, trials, [float(np.exp(own)) for own in c])
    return replace(rig, free=FreeLaw(throughout=(law,), curves=curves))
