"""Parameters of the best explanation: a table, and how they are uncertain together."""

from collections.abc import Mapping, Sequence
from typing import Any

from diagnosis.assessment.uncertainty.values_by_part import ValuesByPart
from diagnosis.in_sigma import in_sigma
from diagnosis.report import html_parts as html
from diagnosis.report.fallible import drawn
from diagnosis.report.figures.joint import describe_joint, draw_joint, pairs_of
from diagnosis.report.sentences.nearest import (
    NOT_AN_EXPLANATION,
    about_as_near,
    differing_motions,
    differing_trials,
    nearest,
)
from diagnosis.report.tables import parameter_table, part_table
from diagnosis.result import Diagnosis

_INTERVALS = (
    "If the explanation and the constants of rig.yaml are right, each interval contains the true "
    "value in 95 of 100 logs. The ellipses show this for two parameters at once: if an ellipse is "
    "tilted, a larger value of one parameter goes with a larger value of the other, or with a "
    "smaller one. Stiffness and damping of the rig are left open in every fit, as a share of their "
    "nominal values."
)

_PARTS = (
    "Each row gives one parameter a value of its own in each {part} and keeps all others common. The "
    "last column is the residual of all trials together with these values; with common values it is "
    "{common}. Only the linear model of the fit is used: a value far from the common one shows a "
    "direction more than a size. Parameters that act alike each take over what one of them does."
)


def parameters_section(found: Diagnosis, report: Mapping[str, Any]) -> list[str]:
    """Everything under this heading; `report` is report.json. Nothing where nothing was fitted."""
    if sentence := nearest(found):
        own = report["nearest"]["parameters"]
        parts = [html.heading("What comes nearest"), html.paragraph(f"{sentence}.")]
        doubt = [html.paragraph(NOT_AN_EXPLANATION)] if own else []
        if others := about_as_near(found):
            doubt.append(html.paragraph(f"{others}."))
        near, trials, motions = found.assessment.nearest, differing_trials, differing_motions
        return [
            *parts,
            *_values(found, own),
            *doubt,
            *_by_part(near.by_trial, html.heading("Trial by trial", level=3), "trial", trials(found)),
            *_by_part(
                near.by_motion,
                html.heading("By the motion of the base", level=3),
                "motion",
                motions(found),
            ),
        ]
    own = report["parameters"]
    return [html.heading("Parameters"), *_values(found, own)] if own else []


def _by_part(by_part: Sequence[ValuesByPart], heading: str, part: str, sentence: str) -> list[str]:
    """Values of its own in each part of an unknown log, if it has several."""
    if not by_part:
        return []
    return [
        heading,
        html.paragraph(_PARTS.format(part=part, common=in_sigma(by_part[0].gap_common))),
        *([html.paragraph(f"{sentence}.")] if sentence else []),
        part_table(by_part, f"Values by {part}"),
    ]


def _values(found: Diagnosis, parameters: Mapping[str, Any]) -> list[str]:
    joint = found.assessment.joint
    if not parameters:
        return []
    parts = [parameter_table(parameters)]
    if not pairs_of(joint):
        return parts
    return [
        *parts,
        html.heading("Joint uncertainty", level=3),
        html.paragraph(_INTERVALS),
        drawn(draw_joint, describe_joint, joint),
    ]
