"""Why to believe the answer: how much is explained, every trial, loops, twist of the shaft."""

from diagnosis.report import html_parts as html
from diagnosis.report.fallible import Part, drawn
from diagnosis.report.figures.loops import describe_loops, draw_loops
from diagnosis.report.figures.trials import describe_trial, draw_trial
from diagnosis.report.figures.twist import describe_twist, draw_twist
from diagnosis.report.sentences.names import best_in_words, label_of
from diagnosis.report.sentences.residual import reduction
from diagnosis.result import Diagnosis
from diagnosis.selection.verdicts.verdict import VerdictKind

_TRIALS = (
    "Grey: measured. Dashed blue: the nominal model. Solid red: {best}. Below each signal: measured "
    "minus predicted, in σ (one standard deviation of the sensor's noise), with each sample as a "
    "thin line and means as a thick one. If only noise is left, 95 % of the samples lie in the grey "
    "band. Where only one line shows, the predictions agree."
)
_LOOPS = (
    "The trials whose loops differ most from those of the nominal model. A loop of torque against "
    "base angle that is equally wide at all rates means dry friction; one that widens with the rate "
    "means damping; a flat part after each reversal means play. For an elastic shaft, lag against "
    "torque is a line."
)
_TWIST = (
    "How far each point of the shaft has turned, at the moment when the nominal model is furthest "
    "off. Friction and damping along the shaft bend the line within the tissue. Effects at the entry "
    "or at the tip put a kink into the line there, or tilt it. Drive and play shift the whole line. "
    "An error of a sensor does not change it."
)


def agreement_parts(found: Diagnosis) -> list[Part]:
    """Everything under this heading, in parts that can be made side by side: a picture takes long."""
    trials = ((_trial, found, i) for i in range(len(found.log.trials)))
    return [(_begin, found), *trials, (_loops, found), (_twist, found)]


def _begin(found: Diagnosis) -> list[str]:
    unknown = found.verdict.kind is VerdictKind.UNKNOWN
    return [
        html.heading("How near it comes" if unknown else "Why to believe it"),
        html.paragraph(reduction(found)),
        html.heading(f"Measured, nominal and {label_of(found, 'explained')}", level=3),
        html.paragraph(_TRIALS.format(best=best_in_words(found))),
    ]


def _trial(found: Diagnosis, i: int) -> list[str]:
    return [drawn(draw_trial, describe_trial, found, i)]


def _loops(found: Diagnosis) -> list[str]:
    return [
        html.heading("Loops of torque and lag", level=3),
        html.paragraph(_LOOPS),
        drawn(draw_loops, describe_loops, found),
    ]


def _twist(found: Diagnosis) -> list[str]:
    twist = found.assessment.twist
    if twist is None:
        return []
    return [
        html.heading("Twist along the shaft", level=3),
        html.paragraph(_TWIST),
        drawn(draw_twist, describe_twist, twist, label_of(found, "explained")),
    ]
