"""Parameters of the best explanation: a table, and how they are uncertain together."""

from collections.abc import Callable, Mapping, Sequence
from typing import Any

from diagnosis.assessment.uncertainty.values_by_part import ValuesByPart
from diagnosis.criteria.assessment import DIFFERING_SHOWN
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
from diagnosis.selection.verdicts.verdict import VerdictKind

_RIGHT = (
    "If the explanation and the constants of rig.yaml are right, each interval contains the true "
    "value in 95 of 100 logs."
)
_JOINTLY = (
    "The ellipses show two parameters at once: if an ellipse is tilted, a larger value of one "
    "parameter goes with a larger value of the other, or with a smaller one. Stiffness and damping of "
    "the rig are left open in every fit, as a share of their nominal values."
)

_BY_TRIAL = (
    "Each row gives one parameter a value of its own in each trial and keeps all others common. The "
    "last column is the residual of all trials together with these values; with common values it is "
    "{common}. Only the linear model of the fit is used: a value far from the common one shows a "
    "direction more than a size. Parameters that act alike each take over what one of them does."
)
_BY_MOTION = (
    "The same, with a value of its own for what the base does when a reading is taken; with common "
    "values the residual is {common}. Where the shaft is soft, what happened before matters as well."
)


def parameters_section(found: Diagnosis, report: Mapping[str, Any]) -> list[str]:
    """Everything under this heading; `report` is report.json. Nothing where nothing was fitted."""
    if nearest(found):
        return _what_comes_nearest(found, report["nearest"]["parameters"])
    own = report["parameters"]
    return [html.heading("Parameters"), *_values(found, own)] if own else []


def _what_comes_nearest(found: Diagnosis, own: Mapping[str, Any]) -> list[str]:
    near, others = found.assessment.nearest, about_as_near(found)
    return [
        html.heading("What comes nearest"),
        html.paragraph(f"{nearest(found)}."),
        *_values(found, own),
        *([html.paragraph(NOT_AN_EXPLANATION)] if own else []),
        *([html.paragraph(f"{others}.")] if others else []),
        *_by_part(
            found, html.heading("Trial by trial", level=3), near.by_trial, _BY_TRIAL, differing_trials
        ),
        *_by_part(
            found,
            html.heading("By the motion of the base", level=3),
            near.by_motion,
            _BY_MOTION,
            differing_motions,
        ),
    ]


def _by_part(
    found: Diagnosis,
    heading: str,
    by_part: Sequence[ValuesByPart],
    how: str,
    differing: Callable[[Diagnosis], str],
) -> list[str]:
    """Values of their own in each part of a log, of what is named and of what takes off something.

    None where a free-form law closes the gap: then nothing has to differ.
    """
    named = found.assessment.nearest.effects
    shown = [own for own in by_part if own.effect in named or own.share >= DIFFERING_SHOWN]
    if not shown or (found.missing is not None and found.missing.closed):
        return []
    sentence = differing(found)
    return [
        heading,
        html.paragraph(how.format(common=in_sigma(shown[0].gap_common))),
        *([html.paragraph(f"{sentence}.")] if sentence else []),
        part_table(shown, "Values by part"),
    ]


def _values(found: Diagnosis, parameters: Mapping[str, Any]) -> list[str]:
    """A table, and ellipses of two at once; of what explains nothing no interval holds a truth."""
    joint = found.assessment.joint
    if not parameters:
        return []
    parts = [parameter_table(parameters)]
    if not pairs_of(joint):
        return parts
    return [
        *parts,
        html.heading("Joint uncertainty", level=3),
        html.paragraph(
            _JOINTLY if found.verdict.kind is VerdictKind.UNKNOWN else f"{_RIGHT} {_JOINTLY}"
        ),
        drawn(draw_joint, describe_joint, joint),
    ]
