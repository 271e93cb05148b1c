"""The tables of `report.html`."""

from collections.abc import Mapping, Sequence
from typing import Any

from diagnosis.effects import LIBRARY
from diagnosis.effects.effect import Parameter
from diagnosis.report.html_parts import table
from diagnosis.selection.record import RecordEntry

_FOUR_DECIMALS = (0.1, 10.0)  # factors near 1 are told by four decimals, else three digits


def parameter_table(parameters: Mapping[str, Any]) -> str:
    """Parameters of what explains the log, with their intervals."""
    rows = [
        (effect, name, f"{p['value']:.4g}", f"{p['low']:.4g} to {p['high']:.4g}", p["unit"])
        for effect, values in parameters.items()
        for name, p in values.items()
    ]
    return table(("effect", "parameter", "value", "95 % interval", "unit"), rows)


def limits_table(limits: Mapping[str, Mapping[str, float]]) -> str:
    """Detection limits of further effects."""
    rows = [(effect, limit_in_words(effect, values)) for effect, values in limits.items()]
    return table(("effect", "may be present and go unseen"), rows)


def search_table(record: Sequence[RecordEntry]) -> str:
    """Every decision of every stage of the search."""
    rows = [
        (
            entry.stage,
            " + ".join(entry.effects) or "nominal rig",
            entry.decision.value,
            "" if entry.gap is None else f"{entry.gap:.3f}",
            "" if entry.score is None else f"{entry.score:.1f}",
            entry.reason,
        )
        for entry in record
    ]
    return table(("stage", "explanation", "decision", "residual / σ", "score", "reason"), rows)


def limit_in_words(effect: str, values: Mapping[str, float]) -> str:
    """How strong an effect may be and go unseen."""
    own = {p.name: p for p in LIBRARY[effect].parameters}
    return ", ".join(_bounded(own[name], value) for name, value in values.items()) or "any strength"


def _bounded(parameter: Parameter, value: float) -> str:
    """The values that go unseen: from the given one to that at which the effect is not there."""
    size = abs(value)
    told = f"{_rounded(size)} {parameter.unit}".removesuffix(" -")
    if parameter.neutral is None:
        return f"{parameter.name} {told}"
    name = f"|{parameter.name}|" if parameter.low < 0 else parameter.name
    return f"{name} {'≥' if size < parameter.neutral else '≤'} {told}"


def _rounded(value: float) -> str:
    low, high = _FOUR_DECIMALS
    return f"{value:.4f}" if low < abs(value) < high else f"{value:.3g}"
