"""The tables of `report.html`."""

import html
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from diagnosis.effects import LIBRARY
from diagnosis.effects.effect import Parameter


def parameter_table(parameters: Mapping[str, Any]) -> str:
    """Parameters of what explains the log, with their intervals."""
    rows = [
        (effect, name, f"{p['value']:.4g}", f"{p['low']:.4g} to {p['high']:.4g}", p["unit"])
        for effect, values in parameters.items()
        for name, p in values.items()
    ]
    return _table(("effect", "parameter", "value", "95 % interval", "unit"), rows)


def hidden_table(hidden: Mapping[str, Mapping[str, float]]) -> str:
    """What further effects may go unseen, and how strong."""
    rows = [(effect, strength(effect, values)) for effect, values in hidden.items()]
    return _table(("effect", "may be there unseen"), rows)


def strength(effect: str, values: Mapping[str, float]) -> str:
    """How strong an effect that hides may be, in words."""
    own = {p.name: p for p in LIBRARY[effect].parameters}
    return ", ".join(_bounded(own[name], value) for name, value in values.items()) or "any strength"


def _bounded(parameter: Parameter, value: float) -> str:
    """The values that hide: from the given one to that at which the effect is not there."""
    size = abs(value)
    told = f"{_rounded(size)} {parameter.unit}".removesuffix(" -")
    if parameter.nothing is None:
        return f"{parameter.name} {told}"
    name = f"|{parameter.name}|" if parameter.low < 0 else parameter.name
    return f"{name} {'≥' if size < parameter.nothing else '≤'} {told}"


def _rounded(value: float) -> str:
    return f"{value:.4f}" if 0.1 < abs(value) < 10 else f"{value:.3g}"


def _table(head: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    cells = "".join(f"<th>{html.escape(name)}</th>" for name in head)
    lines = ["".join(f"<td>{html.escape(cell)}</td>" for cell in row) for row in rows]
    return f"<table><tr>{cells}</tr>{''.join(f'<tr>{line}</tr>' for line in lines)}</table>"
