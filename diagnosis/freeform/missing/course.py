"""The course of a free-form law in words, where the log determines it."""

import statistics
from collections.abc import Sequence
from itertools import pairwise

from diagnosis.freeform.family import TRIALS
from diagnosis.freeform.law_curve import Law

_WIDEST, _FEWEST = 4.0, 3  # width of a band that tells something, of the median of |curve|; points
_STRONGER = 1.05  # times as strong one way, from which that is told
_ABRUPT = 0.02  # of the range of x, within which a step is one
_NOTHING = 1e-6  # of the range of x or y: told as 0
_MOSTLY = 0.8  # of the range of a curve, that its ends differ by where it rises or falls


def course_of(law: Law) -> str:
    """The course of a law, in words, where the log determines it."""
    own = "" if law.unit == "-" else f" {law.unit}"
    if law.variable == "event":
        after = law.y[2]  # the level that the first change comes to
        change = f"by {after:.3g}{own}" if own else f"{after:.3g} times as large"
        return f"{law.title}, {change} at {0.5 * (law.x[1] + law.x[2]):.2f} {law.x_unit}"
    if law.variable == "direction":
        return f"{law.title} {_by_direction(law.y[0], law.y[-1], own)}"
    x, y = (_rounded_to_zero(values) for values in _determined(law))
    low, high = min(y), max(y)
    if high == low:
        return f"{law.title} is {low:.3g}{own}"
    rises = y[-1] - y[0]
    unit = "" if law.x_unit == "-" else f" {law.x_unit}"
    if (at := _step_at(x, y)) is not None:
        return f"{law.title} steps from {y[0]:.3g} to {y[-1]:.3g}{own} at {at:.3g}{unit}"
    if abs(rises) >= _MOSTLY * (high - low):
        verb = "rises" if rises > 0 else "falls"
        between = f"between {x[0]:.3g} and {x[-1]:.3g}{unit}"
        if law.x_unit == TRIALS:
            between = f"from trial {x[0]:.0f} to trial {x[-1]:.0f}"
        return f"{law.title} {verb} from {y[0]:.3g} to {y[-1]:.3g}{own} {between}"
    return f"{law.title} varies between {low:.3g} and {high:.3g}{own}"


def _rounded_to_zero(values: Sequence[float]) -> tuple[float, ...]:
    """Values with 0 for those that are nothing beside their range."""
    nothing = _NOTHING * (max(values) - min(values))
    return tuple(0.0 if abs(value) < nothing else value for value in values)


def _step_at(x: Sequence[float], y: Sequence[float]) -> float | None:
    """Where a curve that is level on both sides steps; None: it has another form."""
    steps = [i for i, (here, next_) in enumerate(pairwise(y)) if here != next_]
    if len(steps) != 1 or x[steps[0] + 1] - x[steps[0]] > _ABRUPT * (x[-1] - x[0]):
        return None
    return 0.5 * (x[steps[0]] + x[steps[0] + 1])


def _by_direction(back: float, forth: float, unit: str) -> str:
    """How a law differs between the directions of turning."""
    if back * forth <= 0:
        return f"is {forth:.3g}{unit} forwards, {back:.3g}{unit} backwards"
    stronger = abs(forth) > abs(back)
    way, ratio = ("forwards", forth / back) if stronger else ("backwards", back / forth)
    if ratio < _STRONGER:
        return f"is {forth:.3g}{unit}, the same in both directions"
    return f"is {ratio:.2g} times as strong {way}"


def _determined(law: Law) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """The points of a curve whose band is not far wider than the curve is large, or changes; all, if few
    are, or if the curve is level there alone."""
    middle = statistics.median(map(abs, law.y))
    points = [*zip(law.x, law.y, law.low, law.high, strict=True)]
    told = [y for _, y, low, high in points if high - low <= _WIDEST * max(abs(y), middle)]
    most = max(_WIDEST * middle, max(told, default=0.0) - min(told, default=0.0))
    known = [(x, y) for x, y, least, greatest in points if greatest - least <= most]
    level_there = len({y for _, y in known}) == 1 and len(set(law.y)) > 1
    if len(known) < _FEWEST or level_there:
        return law.x, law.y
    return tuple(x for x, _ in known), tuple(y for _, y in known)
