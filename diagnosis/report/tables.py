"""The tables of `report.html`."""

import math
from collections.abc import Iterator, Mapping, Sequence
from itertools import groupby
from typing import Any

from diagnosis.assessment.detection_limits import DetectionLimit
from diagnosis.assessment.uncertainty.values_by_part import ValuesByPart
from diagnosis.effects import LIBRARY
from diagnosis.effects.effect import Parameter
from diagnosis.in_sigma import over_sigma
from diagnosis.report.html_parts import table
from diagnosis.report.sentences.names import explanations
from diagnosis.result import Diagnosis
from diagnosis.selection.record import Decision, RecordEntry

_FOUR_DECIMALS = (0.1, 10.0)  # factors near 1 are told by four decimals, else three digits
_LEAST_DIGITS, _MOST_DIGITS = 4, 9  # significant, of parameters
_SHOWN_SETS = 8  # sets of effects that were dropped for one reason; single effects are all named


def parameter_table(parameters: Mapping[str, Any]) -> str:
    """Parameters of what explains the log, with their intervals."""
    rows = [
        (effect, name, value, f"{low} to {high}", unit)
        for effect, values in parameters.items()
        for name, value, low, high, unit in interval_rows(values)
    ]
    head = ("effect", "parameter", "value", "95 % interval", "unit")
    return table(head, rows, "Fitted parameters")


def interval_rows(values: Mapping[str, Any]) -> Iterator[tuple[str, str, str, str, str]]:
    """Name, value, both ends of the interval and unit, with digits that tell the ends apart."""
    for name, p in values.items():
        each = (p["value"], p["low"], p["high"])
        digits = _digits(*each)
        value, low, high = (f"{number:.{digits}g}" for number in each)
        yield name, value, low, high, p["unit"]


def _digits(value: float, low: float, high: float) -> int:
    """Significant digits of these: one or two of the width of the interval, four at least."""
    width, size = high - low, max(abs(value), abs(low), abs(high))
    if not 0.0 < width < size:
        return _LEAST_DIGITS
    return min(max(_LEAST_DIGITS, math.ceil(math.log10(size / width)) + 1), _MOST_DIGITS)


def part_table(by_part: Sequence[ValuesByPart], caption: str) -> str:
    """Parameters with a value of their own in each part of a log."""
    rows = [
        (
            own.effect,
            own.parameter,
            *("not determined" if v is None else f"{v:.3g}" for v in own.values),
            own.unit,
            over_sigma(own.gap_own),
        )
        for own in by_part
    ]
    head = ("effect", "parameter", *by_part[0].parts, "unit", "residual / σ")
    return table(head, rows, caption)


def explanation_table(found: Diagnosis) -> str:
    """Explanations with their probabilities; a set of effects is one row."""
    rows = [(name, f"{p:.3f}") for name, p in explanations(found)]
    return table(("explanation", "probability"), rows, "Probability of each explanation")


def limits_table(limits: Mapping[str, DetectionLimit]) -> str:
    """Detection limits of further effects."""
    rows = [(effect, limit_in_words(effect, limit.parameters)) for effect, limit in limits.items()]
    return table(("effect", "may be present and go unseen"), rows, "Detection limits")


def search_table(stage: str, record: Sequence[RecordEntry]) -> str:
    """Every decision of a stage of the search; what was not fitted for one reason is one row."""
    rows = [_row(list(same)) for _, same in groupby(record, _as_one)]
    head = ("explanation", "decision", "residual / σ", "score", "reason")
    return table(head, rows, f"Decisions: {stage}")


def _as_one(entry: RecordEntry) -> tuple[Decision, str] | int:
    """What entries of one row have in common; a fit has a row of its own."""
    return (entry.decision, entry.reason) if entry.gap is None else id(entry)


def _row(same: Sequence[RecordEntry]) -> tuple[str, ...]:
    first = same[0]
    gap = "" if first.gap is None else over_sigma(first.gap)
    score = "" if first.score is None else f"{first.score:.0f}"
    return _named(same), first.decision.value, gap, score, first.reason


def _named(same: Sequence[RecordEntry]) -> str:
    every = [" + ".join(entry.effects) or "nominal rig" for entry in same]
    more = len(every) - _SHOWN_SETS
    if more <= 0 or len(same[0].effects) < 2:
        return ", ".join(every)
    return f"{', '.join(every[:_SHOWN_SETS])} and {more} more"


def limit_in_words(effect: str, values: Mapping[str, float]) -> str:
    """How strong an effect may be and go unseen."""
    own = {p.name: p for p in LIBRARY[effect].parameters}
    return ", ".join(_bounded(own[name], value) for name, value in values.items()) or "any strength"


def _bounded(parameter: Parameter, value: float) -> str:
    """The values that go unseen: from the given one to that at which the effect is not there."""
    size = abs(value)
    if parameter.neutral is None:
        return f"{parameter.name} {size:.3g} {parameter.unit}".removesuffix(" -")
    number = _factor(size) if parameter.unit == "-" else f"{size:.3g}"
    told = f"{number} {parameter.unit}".removesuffix(" -")
    if parameter.is_a_factor and size > 0:
        ends = sorted((size, 1.0 / size))
        return f"{parameter.name} {_factor(ends[0])} to {_factor(ends[1])}"
    name = f"|{parameter.name}|" if parameter.low < 0 else parameter.name
    return f"{name} {'≥' if size < parameter.neutral else '≤'} {told}"


def _factor(value: float) -> str:
    low, high = _FOUR_DECIMALS
    return f"{value:.4f}" if low < abs(value) < high else f"{value:.3g}"
