"""What explanations and predictions are called."""

from dataclasses import replace

import pytest
from diagnosis_fixtures import concluding
from free_forms import missing_with

from diagnosis.report.sentences.names import (
    best_in_words,
    by_free_law,
    explanation_name,
    explanations,
    label_of,
)
from diagnosis.report.sentences.nearest import nearest
from diagnosis.report.sentences.residual import largest_parts
from diagnosis.selection.verdicts.verdict import VerdictKind

TWO = ("tip_drag", "torque_bias")


def test_explanations_are_the_ranking_without_what_rounds_to_nothing(dry):
    assert explanations(dry.found)[0][0] == "coulomb_friction"
    assert sum(p for _, p in dry.found.verdict.ranking) == pytest.approx(1.0)
    unknown = concluding(dry.found, ranking=((("unknown",), 1.0), (("none",), 0.0)))
    assert explanations(unknown) == [("unknown", 1.0)]
    assert explanation_name(("torque_bias", "tip_drag")) == explanation_name(TWO)
    assert explanation_name(()) == "none"


def test_the_best_of_an_unknown_log_is_called_no_explanation(dry):
    unknown = replace(dry.found, verdict=replace(dry.found.verdict, kind=VerdictKind.UNKNOWN))
    called = {found.verdict.kind: label_of(found, "explained") for found in (dry.found, unknown)}
    assert called == {VerdictKind.EXPLAINED: "explained", VerdictKind.UNKNOWN: "nearest"}
    assert label_of(unknown, "nominal") == "nominal"
    assert best_in_words(dry.found) == "the best explanation"
    assert "; of what comes nearest: largest in" in largest_parts(unknown)


def test_what_is_with_a_free_form_law_is_called_that(dry):
    unknown = concluding(dry.found, kind=VerdictKind.UNKNOWN, effects=())
    found, without = (replace(unknown, missing=m) for m in (missing_with(), missing_with(law=None)))
    assert [by_free_law(one) for one in (found, without, dry.found)] == [True, False, False]
    assert label_of(found, "explained") == "free-form law"
    assert label_of(without, "explained") == "nearest"
    assert label_of(found, "nominal") == "nominal"
    assert "; of the free-form law: largest in" in largest_parts(found)
    # The parts of the residual that is left are those of the law, not of what comes nearest.
    assert "the remaining residual is" not in nearest(found)
    assert "the remaining residual is" in nearest(without)
