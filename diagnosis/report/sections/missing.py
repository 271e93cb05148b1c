"""What is not in the library: where it acts, what it depends on, and as what law."""

import math

from diagnosis.freeform.in_words import PLACES, VARIABLES
from diagnosis.freeform.missing import Missing
from diagnosis.report import html_parts as html
from diagnosis.report.fallible import drawn
from diagnosis.report.figures.law import describe_law, draw_law
from diagnosis.result import Diagnosis

_LAW = (
    "A free-form law assumes a place and what it depends on, and of its course that it is smooth, no "
    "more. It is fitted through the simulation, as effects are; the readings called free-form in this "
    "report are with it. It names no cause: other laws of the same place and variable may do as well."
)
_PLACES = (
    "Probability of each place, from the best law that may live there: how much of the gap it leaves on "
    "trials that its fit has not seen, and with how much freedom."
)
_GAPS = (
    "For each variable the law that leaves least, on trials that its fit has not seen, over the noise "
    "and what the other trials leave open of the curve; 1 is the noise floor. Only the first few are "
    "fitted to the whole log, the others to a decimated one, and their gap is that of the fit."
)


def missing_section(found: Diagnosis) -> list[str]:
    """Everything under this heading; nothing where no such law was looked for."""
    missing = found.missing
    if missing is None:
        return []
    law = missing.law
    picture = [html.paragraph(_LAW), drawn(draw_law, describe_law, law)] if law else []
    return [
        html.heading("What is missing"),
        *picture,
        html.heading("Where it acts", level=3),
        html.paragraph(_PLACES),
        _place_table(missing),
        html.heading("What it depends on", level=3),
        html.paragraph(_GAPS),
        _variable_table(missing),
    ]


def _place_table(missing: Missing) -> str:
    ranked = sorted(missing.place.items(), key=lambda item: -item[1])
    rows = [(PLACES[place], f"{p:.2f}") for place, p in ranked]
    return html.table(("what is missing acts", "probability"), rows, "Where it acts")


def _variable_table(missing: Missing) -> str:
    rows = [
        (VARIABLES[one.variable], one.title, PLACES[one.place], _gap(one.gap_after))
        for one in missing.depends_on
    ]
    head = ("depends on", "law of", "acts", "gap after / σ")
    return html.table(head, rows, "What it depends on")


def _gap(gap_sigma: float) -> str:
    """Infinite where an unseen trial could not be simulated with what the others say."""
    return f"{gap_sigma:.2f}" if math.isfinite(gap_sigma) else "not simulated"
