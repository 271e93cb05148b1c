"""How the search went: every decision with its reason, folded by stage."""

from collections import Counter
from collections.abc import Sequence
from itertools import groupby

from diagnosis.in_sigma import in_sigma
from diagnosis.report import html_parts as html
from diagnosis.report.tables import search_table
from diagnosis.result import Diagnosis
from diagnosis.selection.record import Decision, RecordEntry

_SEARCH = (
    "Which stage made, kept or dropped which explanation, and why: open a stage to see its decisions. "
    "Until they are finalists, explanations are fitted to the decimated log. Its samples are means, "
    "which have less noise, so their residuals are larger in σ than those of the full log. Of many "
    "sets of effects, the first are shown; report.json has all."
)
_NEAREST = "verdict"  # the stage that what came nearest has reached


def search_section(found: Diagnosis) -> list[str]:
    """Everything under this heading."""
    stages = groupby(found.record, lambda entry: entry.stage)
    return [
        html.heading("How the search went"),
        html.paragraph(_SEARCH),
        *(_folded(stage, list(entries)) for stage, entries in stages),
    ]


def _folded(stage: str, entries: Sequence[RecordEntry]) -> str:
    table = search_table(stage, entries)
    return html.folded(_summary(stage, entries), table, unfolded=stage == _NEAREST)


def _summary(stage: str, entries: Sequence[RecordEntry]) -> str:
    """How many explanations met with what, and the lowest residual of a fit."""
    counts = Counter(entry.decision for entry in entries)
    told = ", ".join(f"{counts[one]} {one}" for one in Decision if counts[one])
    gaps = [entry.gap for entry in entries if entry.gap is not None]
    lowest = f"; lowest residual {in_sigma(min(gaps))}" if gaps else ""
    return f"{stage}: {told}{lowest}"
