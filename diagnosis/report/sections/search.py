"""How the search went: every decision with its reason."""

from diagnosis.report import html_parts as html
from diagnosis.report.tables import search_table
from diagnosis.result import Diagnosis

_SEARCH = (
    "Which stage made, kept or dropped which explanation, and why. Until they are finalists, "
    "explanations are fitted to the decimated log. Its samples are means, which have less noise, so "
    "their residuals are larger in σ than those of the full log. Of many sets of "
    "effects, the first are shown; report.json has all."
)


def search_section(found: Diagnosis) -> list[str]:
    """Everything under this heading."""
    return [
        html.heading("How the search went"),
        html.paragraph(_SEARCH),
        search_table(found.record),
    ]
