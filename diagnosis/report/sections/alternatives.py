"""What else it may be: probabilities, what looks alike, what the trials cannot tell."""

import math

from diagnosis.assessment.identifiability import unidentifiable
from diagnosis.criteria.selection import NESTED_LEAD, SIMPLE_LEAD
from diagnosis.report import html_parts as html
from diagnosis.report.fallible import drawn
from diagnosis.report.figures.ranking import describe_ranking, draw_ranking
from diagnosis.report.sentences.residual import with_one_more
from diagnosis.report.sentences.verdict import alike
from diagnosis.report.tables import explanation_table
from diagnosis.result import Diagnosis
from diagnosis.selection.verdicts.verdict import VerdictKind

_RANKING = (
    "Probability of each explanation, given the library, the noise and these trials. Effects that "
    f"explain a log together are one explanation. Odds below {math.exp(SIMPLE_LEAD / 2):.0f} to 1 "
    "leave it undecided, and a second effect must lead by more than that to be named. Between an effect "
    f"and a simpler one that it contains, {math.exp(NESTED_LEAD / 2):.0f} to 1 decides."
)


_NONE_PROBABLE = (
    "Nothing that was tried, neither single effects nor sets of them, reaches the noise of the "
    "sensors, so no explanation has a probability."
)


def alternatives_section(found: Diagnosis) -> list[str]:
    """Everything under this heading."""
    return [
        html.heading("What else it may be"),
        *([html.paragraph(f"{same}.")] if (same := alike(found)) else []),
        *_probabilities(found),
        *([html.paragraph(more)] if (more := with_one_more(found)) else []),
        html.heading("What these trials cannot tell", level=3),
        html.bullets(
            list(unidentifiable(found.log))
            or ["Every effect of the library would show in these trials."]
        ),
    ]


def _probabilities(found: Diagnosis) -> list[str]:
    if found.verdict.kind is VerdictKind.UNKNOWN:
        return [html.paragraph(_NONE_PROBABLE)]
    return [
        html.paragraph(_RANKING),
        drawn(draw_ranking, describe_ranking, found),
        explanation_table(found),
    ]
