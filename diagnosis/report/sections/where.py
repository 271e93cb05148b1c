"""Where the residual is: by part, along the motion, in its spectrum, and which signal leads."""

from diagnosis.report import html_parts as html
from diagnosis.report.fallible import drawn
from diagnosis.report.figures.along_motion import describe_along_motion, draw_along_motion
from diagnosis.report.figures.breakdown import describe_breakdown, draw_breakdown
from diagnosis.report.figures.memory import describe_memory, draw_memory
from diagnosis.report.sentences import best_in_words, largest_parts, largest_residual, leading
from diagnosis.result import Diagnosis

_BREAKDOWN = (
    "Root mean square of measured minus predicted, in units of each sensor's noise (σ), of the nominal "
    "model and of {best}."
)
_ALONG = (
    "A mean residual that steps with the sign of the rate is dry friction, one that grows with the rate "
    "is damping; one that varies along the stroke, either way alike, is a matter of the angle (a bent "
    "shaft, a sensor); one that is largest just after a reversal is play or stiction."
)
_MEMORY = (
    "Noise is as strong at all frequencies (black line) and correlated with itself at none of the lags "
    "(grey band: 95 of 100). What rises at low frequency, or stays out of the band for seconds, is "
    "something slow that the model lacks; a peak is a resonance or a disturbance."
)
_LEADS = (
    "What happens at the drive, or a shaft that is too stiff or too soft, shows in the torque first; "
    "what happens at the tip shows there first; friction and damping all along the shaft show in both "
    "at once; what one sensor does alone does not show in the other."
)


def where_section(found: Diagnosis) -> list[str]:
    """Everything under this heading."""
    return [
        html.heading("Where the residual is"),
        html.paragraph(_BREAKDOWN.format(best=best_in_words(found))),
        drawn(draw_breakdown, describe_breakdown, found),
        html.paragraph(f"{largest_parts(found)}."),
        html.paragraph(f"{largest_residual(found)}."),
        html.heading("Along the motion", level=3),
        html.paragraph(_ALONG),
        drawn(draw_along_motion, describe_along_motion, found),
        html.heading("Spectrum and memory", level=3),
        html.paragraph(_MEMORY),
        drawn(draw_memory, describe_memory, found),
        html.heading("Which signal leads", level=3),
        html.paragraph(f"{leading(found)}."),
        html.paragraph(_LEADS),
    ]
