"""What each effect of the library changes beside half of an explanation: columns for linear algebra.

Secants about the half are good to third order, where those about the nominal rig or about all of it
are good to first.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from diagnosis.effects import IMPERFECTIONS
from diagnosis.fitting.parameterization import starts
from diagnosis.selection.equivalence.noiseless_log import NoiselessLog

Array = NDArray[np.float64]

_SMALL = 0.2  # share of a start at which the effect of a scale, or of a filter, is straight
_ALIKE = 0.9  # correlation of two changes from which one is taken as strong as the other


@dataclass(frozen=True, kw_only=True, eq=False)
class EffectChange:
    """What an effect changes of all readings, / sigma, (N,), and the vector part at which it does so."""

    name: str
    part: Array
    change: Array


def change_of(log: NoiselessLog, name: str) -> EffectChange:
    """What an effect changes beside half of what the explanation names.

    One that changes alike is taken as strong as that half: what friction changes is not straight.
    """
    effect = log.problem.library[name]
    if name in log.own:
        return _change_at(log, name, log.halved[name], log.own[name])
    each = starts(effect)
    share = _SMALL if effect.parameters[0].neutral == 1.0 or name in IMPERFECTIONS else 1.0
    first = _change_at(log, name, effect.weakened(each[len(each) // 2], share))
    amount = _amount(first.change, log.middle)
    return first if amount is None else _change_at(log, name, effect.weakened(first.part, amount))


def _change_at(log: NoiselessLog, name: str, part: Array, there: Array | None = None) -> EffectChange:
    """What an effect with this part of the vector changes; `there`: which it then has in all."""
    whole = log.halved | {name: part if there is None else there}
    return EffectChange(name=name, part=part, change=log.middle - log.readings(whole))


def _amount(change: Array, wanted: Array) -> float | None:
    """Times a change that comes nearest to what is wanted; None: it changes in another way."""
    power, common = float(change @ change), float(change @ wanted)
    if common <= _ALIKE * math.sqrt(power * float(wanted @ wanted)):
        return None
    return common / power
