"""Detection limits: what may be there and go unseen."""

from diagnosis.report import html_parts as html
from diagnosis.report.fallible import drawn
from diagnosis.report.figures.detection_limits import describe_limits, draw_limits
from diagnosis.report.tables import limits_table
from diagnosis.result import Diagnosis

_LIMITS = (
    "How strong each further effect may be and go unseen in these trials: of one that is stronger, "
    "95 in 100 logs like this would show it. The picture sets each beside something that this rig has. "
    "Limits on factors apply both ways."
)


def limits_section(found: Diagnosis) -> list[str]:
    """Everything under this heading; nothing where limits are not known."""
    limits = found.assessment.detection_limits
    if not limits:
        return []
    return [
        html.heading("Detection limits"),
        html.paragraph(_LIMITS),
        drawn(draw_limits, describe_limits, found),
        limits_table(limits),
    ]
