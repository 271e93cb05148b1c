"""`report.html`: the diagnosis for people, in one file that opens without a network."""

import math
from collections.abc import Mapping
from typing import Any

from diagnosis.criteria import NESTED_LEAD, SIMPLE_LEAD
from diagnosis.report import html_parts as html
from diagnosis.report.figures.overview import draw_ranking, draw_trials
from diagnosis.report.sensors import imperfections
from diagnosis.report.sentences import (
    alike,
    headline,
    nearest,
    reduction,
    replay_quality,
    with_one_more,
)
from diagnosis.report.tables import limits_table, parameter_table, search_table
from diagnosis.report.where import where_section
from diagnosis.result import Diagnosis

_RANKING = (
    "Probability of each explanation, given the library, the noise and these trials. Two effects that "
    f"explain a log together share theirs. Odds below {math.exp(SIMPLE_LEAD / 2):.0f} to 1 decide "
    "nothing: a second effect, or more parameters, have to lead by more before they are named. An "
    f"effect that contains a simpler one has to lead that by {math.exp(NESTED_LEAD / 2):.0f} to 1."
)
_LIMITS = (
    "How strong each further effect may be and go unseen in these trials: of one that is stronger, "
    "95 in 100 logs like this would show it. Limits on factors apply both ways."
)
_TRIALS = (
    "Grey: measured. Below each signal: measured minus predicted, in σ; in the grey band lie 95 % of "
    "the samples if nothing but noise is left."
)
_NEAREST = (
    "This is not an explanation: something else is at work as well, or instead. Its intervals are wide "
    "enough for what it leaves, but they assume that the rest is like noise."
)
_SEARCH = "Which stage made, kept or dropped which explanation, and why."


def page(found: Diagnosis, report: Mapping[str, Any]) -> str:
    """The whole page; `report` is report.json."""
    parts = [
        html.heading(headline(found), level=1),
        *html.warnings(report["warnings"]),
        *([html.paragraph(f"{alike(found)}.")] if alike(found) else []),
        *([html.paragraph(sensors)] if (sensors := imperfections(found)) else []),
        *_nearest(found, report),
        *where_section(found),
        *_which(found, report),
        html.heading("How much is explained"),
        html.paragraph(reduction(found)),
        html.paragraph(with_one_more(found)),
        *_trials(found),
        *_limits(found),
        html.heading("What these trials cannot tell"),
        html.bullets(_open_questions(report)),
        html.heading("Noise and numerical error"),
        html.bullets(replay_quality(found)),
        html.heading("How the search went"),
        html.paragraph(_SEARCH),
        search_table(found.record),
    ]
    return html.document("Gap report", parts)


def _nearest(found: Diagnosis, report: Mapping[str, Any]) -> list[str]:
    """What comes nearest, where nothing explains the log."""
    sentence = nearest(found)
    if not sentence:
        return []
    return [
        html.heading("What comes nearest"),
        html.paragraph(f"{sentence}."),
        *(
            [parameter_table(report["nearest"]["parameters"])]
            if found.assessment.nearest.effects
            else []
        ),
        html.paragraph(_NEAREST),
    ]


def _which(found: Diagnosis, report: Mapping[str, Any]) -> list[str]:
    ranked = ", ".join(f"{name} {p:.3f}" for name, p in found.verdict.ranking[:3])
    parts = [
        html.heading("Which effects explain it"),
        html.paragraph(_RANKING),
        html.picture(draw_ranking(found), f"Probabilities of explanations: {ranked}"),
    ]
    return [*parts, parameter_table(report["parameters"])] if report["parameters"] else parts


def _trials(found: Diagnosis) -> list[str]:
    return [
        html.heading("Measured, nominal and explained"),
        html.paragraph(_TRIALS),
        html.picture(draw_trials(found), "Time series of every trial, with residuals below"),
    ]


def _limits(found: Diagnosis) -> list[str]:
    limits = found.assessment.detection_limits
    if not limits:
        return []
    return [html.heading("Detection limits"), html.paragraph(_LIMITS), limits_table(limits)]


def _open_questions(report: Mapping[str, Any]) -> list[str]:
    advice = report["next_experiment"]
    lines = [*report["cannot_tell"], *([f"Next: {advice}"] if advice else [])]
    return lines or ["Every effect of the library would show in these trials."]
