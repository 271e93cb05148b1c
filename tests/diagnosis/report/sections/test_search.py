"""How the search went."""

from dataclasses import replace
from itertools import groupby

from diagnosis_fixtures import scored
from html_outline import HtmlOutline

from diagnosis.report.sections.search import search_section
from diagnosis.selection.record import dropped, made, not_fitted


def test_every_effect_that_was_tried_is_there_with_every_reason(dry):
    said = "".join(search_section(dry.found))
    fitted = [entry for entry in dry.found.record if entry.gap is not None]
    assert len(HtmlOutline(said).attributes("tr")) > len(fitted)
    assert all(name in said for entry in dry.found.record for name in entry.effects)
    assert "expected to stay far above what is at the noise floor" in said


def test_every_stage_is_folded_but_that_of_the_verdict(dry):
    folds = HtmlOutline("".join(search_section(dry.found))).attributes("details")
    stages = [stage for stage, _ in groupby(dry.found.record, lambda entry: entry.stage)]
    assert len(folds) == len(stages) > 3
    assert [stage for stage, own in zip(stages, folds, strict=True) if "open" in own] == ["verdict"]


def test_a_summary_counts_decisions_and_has_the_lowest_residual(dry):
    record = (
        *not_fitted("pairs", [("tip_drag", "stiction")], "promises too little"),
        *made("pairs", [scored(["tip_drag"], 20.0), scored(["stiction"], 21.0)]),
        *dropped("pairs", [scored(["stiction"], 21.0)], "far"),
        *not_fitted("three effects", [("tip_drag", "stiction", "torque_bias")], "too little"),
    )
    said = "".join(search_section(replace(dry.found, record=record)))
    assert "<summary>pairs: 2 made, 2 dropped; lowest residual 1.00 σ</summary>" in said
    assert "<summary>three effects: 1 dropped</summary>" in said
