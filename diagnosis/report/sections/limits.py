"""Detection limits: what may be there and go unseen."""

from diagnosis.report import html_parts as html
from diagnosis.report.fallible import drawn
from diagnosis.report.figures.detection_limits import describe_limits, draw_limits
from diagnosis.report.tables import limits_table
from diagnosis.result import Diagnosis

_LIMITS = (
    "How strong each further effect may be without being seen in these trials: an effect that is "
    "stronger would be seen in 95 of 100 such logs. The picture compares each limit with a property "
    "of this rig."
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
