"""What `needle diagnose` prints: the answer, where the residual is, parameters, ranking, limits."""

from collections.abc import Iterator, Mapping
from typing import Any

from rich.console import Console
from rich.table import Table
from rich.text import Text

from diagnosis.assessment.identifiability import unidentifiable
from diagnosis.in_sigma import over_sigma
from diagnosis.report.answer import answer
from diagnosis.report.json_report import as_json
from diagnosis.report.sensors import imperfections
from diagnosis.report.sentences.names import explanations, label_of
from diagnosis.report.sentences.nearest import (
    NOT_AN_EXPLANATION,
    about_as_near,
    differing_motions,
    differing_trials,
)
from diagnosis.report.sentences.residual import in_one_trial, largest_parts, largest_residual
from diagnosis.report.tables import interval_rows, limit_in_words
from diagnosis.residuals.residual_breakdown import ResidualBreakdown, band_name
from diagnosis.result import Diagnosis
from diagnosis.selection.verdicts.verdict import VerdictKind
from scripts.tables import print_table

_SHOWN = 5  # explanations, with their probabilities


def summary(found: Diagnosis, console: Console) -> None:
    """Print all of it. Warnings of the log were told while it was read."""
    told = found.assessment
    what, sure, then = answer(found)
    console.print(Text(what, "bold"))
    for sentence in (sure, then):
        console.print(sentence, highlight=False)
    sentence = imperfections(found)
    if sentence and found.verdict.kind is not VerdictKind.NONE:  # which begins with it
        console.print(sentence, highlight=False)
    for warning in found.warnings:
        if warning not in found.log.warnings:
            console.print(f"warning: {warning}", highlight=False)
    print_table(console, _breakdown_table(found))
    print_table(console, _band_table(found))
    for sentence in (largest_parts(found), largest_residual(found), in_one_trial(found)):
        if sentence:
            console.print(sentence, highlight=False)
    if found.verdict.effects:
        print_table(
            console, _parameter_table(as_json(found)["parameters"], _what_explains(found)), keys=2
        )
    elif found.assessment.nearest.effects:
        parameters = as_json(found)["nearest"]["parameters"]
        print_table(console, _parameter_table(parameters, "What comes nearest"), keys=2)
        console.print(NOT_AN_EXPLANATION, highlight=False)
        more = (about_as_near(found), differing_trials(found), differing_motions(found))
        for sentence in filter(None, more):
            console.print(f"{sentence}.", highlight=False)
    if found.verdict.kind is not VerdictKind.UNKNOWN:  # then no explanation has a probability
        print_table(console, _ranking_table(found))
    if told.detection_limits and not found.verdict.effects:
        print_table(console, _limits_table(found))
    for sentence in unidentifiable(found.log):
        console.print(f"not shown: {sentence}", highlight=False)


def _what_explains(found: Diagnosis) -> str:
    undecided = found.verdict.kind is VerdictKind.UNDECIDED
    return "The first of these explanations" if undecided else "What explains it"


def _breakdown_table(found: Diagnosis) -> Table:
    table = Table(
        "where", "nominal", label_of(found, "explained"), title="Residual / σ, fitted to all trials"
    )
    before, after = found.assessment.breakdown, found.assessment.breakdown_after
    for (name, gap), (_, left) in zip(_by_part(before), _by_part(after), strict=True):
        table.add_row(name, over_sigma(gap), over_sigma(left))
    return table


def _by_part(parts: ResidualBreakdown) -> Iterator[tuple[str, float]]:
    yield from parts.signal.items()
    yield from parts.phase.items()
    for depth, value in parts.depth_mm:
        yield f"{depth:g} mm deep", value


def _band_table(found: Diagnosis) -> Table:
    """Of a band, 1 is what white noise has in it: a slow residual comes to far more than over all."""
    title = "By frequency / that of white noise"
    table = Table("band", "nominal", label_of(found, "explained"), title=title)
    before, after = found.assessment.breakdown.band_hz, found.assessment.breakdown_after.band_hz
    for (low, high, gap), (*_, left) in zip(before, after, strict=True):
        table.add_row(band_name(low, high), over_sigma(gap), over_sigma(left))
    return table


def _parameter_table(parameters: Mapping[str, Any], title: str) -> Table:
    table = Table("effect", "parameter", "value", "95 % interval", "unit", title=title)
    for effect, values in parameters.items():
        for name, value, low, high, unit in interval_rows(values):
            table.add_row(effect, name, value, f"{low} to {high}", unit)
    return table


def _limits_table(found: Diagnosis) -> Table:
    table = Table("effect", "may be present and go unseen", title="Detection limits")
    for effect, limit in found.assessment.detection_limits.items():
        table.add_row(effect, limit_in_words(effect, limit.parameters))
    return table


def _ranking_table(found: Diagnosis) -> Table:
    table = Table("explanation", "probability", title="Probability of each explanation")
    every = explanations(found)
    for name, probability in every[:_SHOWN]:
        table.add_row(name, f"{probability:.3f}")
    if rest := every[_SHOWN:]:
        table.add_row(f"{len(rest)} more", f"{sum(p for _, p in rest):.3f}")
    return table
