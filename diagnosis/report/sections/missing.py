"""What is not in the library: where it acts, what it depends on, and as what law."""

import math

from diagnosis.freeform.missing.in_words import laws_of
from diagnosis.freeform.missing.missing import Dependence, Missing
from diagnosis.freeform.missing.words import PLACES, VARIABLES
from diagnosis.in_sigma import over_sigma
from diagnosis.report import html_parts as html
from diagnosis.report.fallible import drawn
from diagnosis.report.figures.law import describe_law, draw_law
from diagnosis.result import Diagnosis

_LAW = (
    "A free-form law assumes a place and a variable; of its curve it assumes only that it is smooth. "
    "It is fitted through the simulation, as effects are; if the curve resembles a plain law, that is "
    "fitted in its place. Where one law is not enough, two or three are fitted together. What this "
    "report calls free-form is predicted with them. No law names a cause: others of the same place and "
    "variable may fit as well."
)
_PLACES = (
    "The probability of each place follows from the best law that may act there: from the gap that "
    "it leaves on trials that the fit has not seen and on those that it has, and from its number of "
    "free parameters."
)
_GAPS = (
    "For each variable, the law that leaves the smallest gap on trials that the fit has not seen, "
    "relative to the noise and to the uncertainty of the curve; 1 is the noise floor. Only the first "
    "few laws are fitted to the full log. The others are fitted to the decimated log, and their gap is "
    "that of the fit. Its samples are means, which have less noise: their gaps are larger in σ, and "
    "compare only with each other."
)


def missing_section(found: Diagnosis) -> list[str]:
    """Everything under this heading; nothing where no such law was looked for."""
    missing = found.missing
    if missing is None:
        return []
    return [
        html.heading("What is missing"),
        *_law(missing),
        html.heading("Where it acts", level=3),
        html.paragraph(_PLACES),
        _place_table(missing),
        html.heading("What it depends on", level=3),
        html.paragraph(_GAPS),
        _variable_table(missing),
    ]


def _law(missing: Missing) -> list[str]:
    pictures = [drawn(draw_law, describe_law, law, period) for law, period in laws_of(missing)]
    return [html.paragraph(_LAW), *pictures] if pictures else []


def _place_table(missing: Missing) -> str:
    ranked = sorted(missing.place.items(), key=lambda item: -item[1])
    rows = [(PLACES[place], f"{p:.2f}") for place, p in ranked]
    return html.table(("what is missing acts", "probability"), rows, "Probability of each place")


def _variable_table(missing: Missing) -> str:
    rows = [
        (VARIABLES[one.variable], one.title, PLACES[one.place], _gap(one.gap_after), _fitted_to(one))
        for one in missing.depends_on
    ]
    head = ("depends on", "law of", "acts", "gap after / σ", "fitted to")
    return html.table(head, rows, "The best law of each variable")


def _fitted_to(one: Dependence) -> str:
    return "decimated log" if one.decimated else "full log"


def _gap(gap_sigma: float) -> str:
    """Infinite where an unseen trial could not be simulated with what the others say."""
    return over_sigma(gap_sigma) if math.isfinite(gap_sigma) else "not simulated"
