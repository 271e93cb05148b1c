"""The section of `report.html` that shows where the gap is: by part, in loops, along the motion."""

from diagnosis.report import html_parts as html
from diagnosis.report.figures.along_motion import draw_along_motion
from diagnosis.report.figures.loops import draw_loops
from diagnosis.report.figures.memory import draw_memory
from diagnosis.report.figures.overview import draw_breakdown
from diagnosis.report.sentences import largest_parts, largest_residual, leading
from diagnosis.result import Diagnosis

_BREAKDOWN = (
    "Root mean square of measured minus predicted, in units of each sensor's noise (σ), before and "
    "after adding the effect."
)
_LOOPS = (
    "Trials whose loops differ most from those of the nominal model. A loop of torque against base "
    "angle that is as wide at any rate is dry friction, one that widens with the rate is damping; a "
    "flat part after each reversal is play; lag against torque is a line for an elastic shaft."
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
        html.heading("Where the gap is"),
        html.paragraph(_BREAKDOWN),
        html.picture(
            draw_breakdown(found),
            "Bars of residual / σ by signal, phase, frequency and depth, nominal and explained",
        ),
        html.paragraph(f"{largest_parts(found)}."),
        html.paragraph(f"{largest_residual(found)}."),
        html.heading("Loops of torque and lag", level=3),
        html.paragraph(_LOOPS),
        html.picture(draw_loops(found), "Torque against base angle, and lag against torque, by trial"),
        html.heading("Along the motion", level=3),
        html.paragraph(_ALONG),
        html.picture(
            draw_along_motion(found), "Residual against base angle, after a reversal, against the rate"
        ),
        html.heading("Spectrum and memory", level=3),
        html.paragraph(_MEMORY),
        html.picture(draw_memory(found), "Spectrum and autocorrelation of the residual by sensor"),
        html.heading("Which signal leads", level=3),
        html.paragraph(f"{leading(found)}."),
        html.paragraph(_LEADS),
    ]
