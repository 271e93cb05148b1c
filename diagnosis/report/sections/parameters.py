"""Parameters of the best explanation: a table, and how they are uncertain together."""

from collections.abc import Mapping
from typing import Any

from diagnosis.report import html_parts as html
from diagnosis.report.fallible import drawn
from diagnosis.report.figures.joint import describe_joint, draw_joint, pairs_of
from diagnosis.report.sentences import NOT_AN_EXPLANATION, nearest
from diagnosis.report.tables import parameter_table
from diagnosis.result import Diagnosis

_INTERVALS = (
    "If the explanation and the constants of rig.yaml are right, each interval contains the true "
    "value in 95 of 100 logs. The ellipses show this for two parameters at once: if an ellipse is "
    "tilted, a larger value of one parameter goes with a larger value of the other, or with a "
    "smaller one. Stiffness and damping of the rig are left open in every fit, as a share of their "
    "nominal values."
)


def parameters_section(found: Diagnosis, report: Mapping[str, Any]) -> list[str]:
    """Everything under this heading; `report` is report.json. Nothing where nothing was fitted."""
    if sentence := nearest(found):
        own = report["nearest"]["parameters"]
        parts = [html.heading("What comes nearest"), html.paragraph(f"{sentence}.")]
        return [*parts, *_values(found, own), *([html.paragraph(NOT_AN_EXPLANATION)] if own else [])]
    own = report["parameters"]
    return [html.heading("Parameters"), *_values(found, own)] if own else []


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
