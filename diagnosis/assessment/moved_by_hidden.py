"""Named parameters that would be others if an effect were there that goes unseen.

The interval of a parameter holds if nothing else is missing. A tip drag and as much less of inserted
length, or a spring in the drive and a softer shaft, are nearly one: at its detection limit the one moves
the other by many times its interval, and that is told.
"""

from collections.abc import Iterator, Mapping

from diagnosis.assessment.detection_limits import DetectionLimit
from diagnosis.assessment.uncertainty.intervals import Interval
from diagnosis.criteria.assessment import HIDDEN_MOVES, HIDDEN_SHARE
from diagnosis.effects import LIBRARY
from diagnosis.effects.effect import Parameter
from diagnosis.selection.richer_forms import overlap


def moved_by_hidden(
    limits: Mapping[str, DetectionLimit], named: Mapping[str, Mapping[str, Interval]]
) -> Iterator[str]:
    """A warning for each named parameter that an effect may move by much unseen: the one that does most.

    Args:
      named: intervals of the parameters of the named effects.
    """
    for effect, own, interval, value, hidden in _moves(limits, named):
        yield _told(effect, own, interval, value, hidden, limits[hidden])


def hidden_that_move(
    limits: Mapping[str, DetectionLimit], named: Mapping[str, Mapping[str, Interval]]
) -> list[str]:
    """The effects of these warnings."""
    return list(dict.fromkeys(hidden for *_, hidden in _moves(limits, named)))


def _moves(
    limits: Mapping[str, DetectionLimit], named: Mapping[str, Mapping[str, Interval]]
) -> Iterator[tuple[str, Parameter, Interval, float, str]]:
    """Each of these effects and parameters, its interval, what it would be, and beside which effect."""
    for effect, parameters in named.items():
        others = {hidden: limit for hidden, limit in limits.items() if not overlap(hidden, (effect,))}
        for own in LIBRARY[effect].reported:
            interval = parameters[own.name]
            beside = {h: o.beside[effect][own.name] for h, o in others.items() if effect in o.beside}
            near = {h: value - own.turns(value - interval.value) for h, value in beside.items()}
            moves = {h: value for h, value in near.items() if _by_much(own, interval, value)}
            if moves:
                most = max(moves, key=lambda hidden: abs(moves[hidden] - interval.value))
                yield effect, own, interval, moves[most], most


def _by_much(own: Parameter, interval: Interval, value: float) -> bool:
    """Whether a value is far outside of an interval, and another strength of the effect."""
    beyond = abs(value - interval.value) / max(interval.high - interval.low, 1e-300)
    if own.neutral is None:
        here, there = interval.value, value
    else:
        here, there = (own.distance_from_neutral(v) for v in (interval.value, value))
    return beyond > HIDDEN_MOVES and abs(there - here) > HIDDEN_SHARE * (own.period or abs(here))


def _told(
    effect: str, own: Parameter, interval: Interval, value: float, hidden: str, limit: DetectionLimit
) -> str:
    units = {p.name: p.unit for p in LIBRARY[hidden].reported}
    strength = ", ".join(f"{name} {_with_unit(v, units[name])}" for name, v in limit.parameters.items())
    return (
        f"if the rig also had {hidden} ({strength}), which this log would not show, {effect} {own.name} "
        f"would be {_with_unit(value, own.unit)} instead of {interval.value:.3g}: "
        f"its interval assumes that the rig has none"
    )


def _with_unit(value: float, unit: str) -> str:
    return f"{value:.3g}" if unit == "-" else f"{value:.3g} {unit}"
