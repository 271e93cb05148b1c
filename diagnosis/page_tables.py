"""The tables of `report.html`."""

import html
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from diagnosis.effects import LIBRARY


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
    return _table(("effect", "may hide up to"), [(e, strength(e, own)) for e, own in hidden.items()])


def strength(effect: str, values: Mapping[str, float]) -> str:
    """The largest strength of an effect that may hide, in words."""
    own = {p.name: p for p in LIBRARY[effect].parameters}
    told = [
        f"{name} {_rounded(value)} {own[name].unit}".removesuffix(" -") for name, value in values.items()
    ]
    return ", ".join(told) or "any strength"


def _rounded(value: float) -> str:
    return f"{value:.4f}" if 0.1 < abs(value) < 10 else f"{value:.3g}"


def _table(head: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    cells = "".join(f"<th>{html.escape(name)}</th>" for name in head)
    lines = ["".join(f"<td>{html.escape(cell)}</td>" for cell in row) for row in rows]
    return f"<table><tr>{cells}</tr>{''.join(f'<tr>{line}</tr>' for line in lines)}</table>"
