"""Where the residual is: by part, along the motion, in its spectrum, and which signal leads."""

from diagnosis.report import html_parts as html
from diagnosis.report.fallible import drawn
from diagnosis.report.figures.along_motion import describe_along_motion, draw_along_motion
from diagnosis.report.figures.breakdown import describe_breakdown, draw_breakdown
from diagnosis.report.figures.memory import describe_memory, draw_memory
from diagnosis.report.sentences.names import best_in_words
from diagnosis.report.sentences.residual import (
    in_one_trial,
    largest_parts,
    largest_residual,
    leading,
)
from diagnosis.result import Diagnosis

_BREAKDOWN = (
    "Root mean square of measured minus predicted, in units of each sensor's noise (σ), for the "
    "nominal model and for {best}, fitted to all trials. In a band of frequencies 1 is what white noise "
    "has there, so that a slow residual comes to far more in its band than over all."
)
_ALONG = (
    "A mean residual that changes sign with the rate means dry friction; one that grows with the "
    "rate means damping. One that depends on the base angle, and is the same in both directions, "
    "comes from the angle itself (a bent shaft, a sensor). One that is largest just after a reversal "
    "means play or stiction."
)
_MEMORY = (
    "White noise is equally strong at all frequencies (dotted line) and has no autocorrelation (grey "
    "band, which holds 95 of 100 lags). A rise at low frequencies, or an autocorrelation that stays "
    "outside the band for seconds, means that the model lacks something slow. A peak means a "
    "resonance or a disturbance."
)
_LEADS = (
    "Effects at the drive, and a shaft that is too stiff or too soft, appear first in the torque. "
    "Effects at the tip appear first in the tip angle. Friction and damping along the whole shaft "
    "appear in both at once. An error of one sensor does not appear in the other."
)


def where_section(found: Diagnosis) -> list[str]:
    """Everything under this heading."""
    return [
        html.heading("Where the residual is"),
        html.paragraph(_BREAKDOWN.format(best=best_in_words(found))),
        drawn(draw_breakdown, describe_breakdown, found),
        html.paragraph(f"{largest_parts(found)}."),
        html.paragraph(f"{largest_residual(found)}."),
        *([html.paragraph(f"{alone}.")] if (alone := in_one_trial(found)) else []),
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
