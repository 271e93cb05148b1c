"""What else it may be."""

from dataclasses import replace

import pytest
from matplotlib.figure import Figure

from diagnosis.report.sections import alternatives
from diagnosis.report.sections.alternatives import alternatives_section
from diagnosis.report.sentences.verdict import alike
from diagnosis.selection.verdicts.verdict import VerdictKind


@pytest.fixture(autouse=True)
def _undrawn(monkeypatch):
    monkeypatch.setattr(alternatives, "draw_ranking", lambda _: Figure())


def test_probabilities_stand_in_a_picture_and_a_table_before_what_cannot_be_told(dry):
    said = "".join(alternatives_section(dry.found))
    parts = ("<h2", "<figure", "<table", "Adding another effect", "What these trials cannot tell")
    assert [said.index(part) for part in parts] == sorted(said.index(part) for part in parts)
    assert "Not testable: load_dependent_friction" in said


def test_what_looks_the_same_comes_first(dry):
    verdict = replace(dry.found.verdict, confusable=(("coulomb_friction",), ("stiction",)))
    found = replace(dry.found, verdict=verdict)
    assert alternatives_section(found)[1] == f"<p>{alike(found)}.</p>"


def test_where_everything_would_show_that_is_said(dry, monkeypatch):
    monkeypatch.setattr(alternatives, "unidentifiable", lambda _: ())
    assert "Every effect of the library would show" in alternatives_section(dry.found)[-1]


def test_of_an_unknown_log_no_explanation_has_a_probability(dry):
    unknown = replace(dry.found, verdict=replace(dry.found.verdict, kind=VerdictKind.UNKNOWN))
    said = "".join(alternatives_section(unknown))
    assert "no explanation has a probability" in said
    assert "<figure" not in said
    assert "<table" not in said
