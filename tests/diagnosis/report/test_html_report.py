"""The page for people."""

from dataclasses import replace

import matplotlib.pyplot as plt
import pytest

from diagnosis.report import html_report
from diagnosis.report.html_report import page
from diagnosis.report.sentences import headline


@pytest.fixture(scope="session")
def dry_page(written):
    return (written / "report.html").read_text()


@pytest.fixture
def undrawn(monkeypatch):
    """Pages without their pictures, which take a second each."""
    for name in ("draw_ranking", "draw_trials"):
        monkeypatch.setattr(html_report, name, lambda _: plt.figure())
    monkeypatch.setattr(html_report, "where_section", lambda _: [])


def test_the_page_starts_with_the_verdict(dry_page, dry):
    assert f"<h1>{headline(dry.found)}</h1>" in dry_page
    assert "explains the gap" in dry_page


def test_the_page_opens_without_a_network(dry_page):
    assert "://" not in dry_page
    assert dry_page.count("data:image/png;base64,") == 6
    assert len(dry_page) < 3e6


def test_the_page_shows_where_the_gap_is(dry_page):
    where = dry_page.split("<h2>Where the gap is</h2>")[1].split("<h2>")[0]
    below = ("Loops of torque and lag", "Along the motion", "Spectrum and memory", "Which signal leads")
    assert [where.count(f"<h3>{title}</h3>") for title in below] == [1] * 4


def test_the_page_shows_how_the_search_went(dry_page, dry):
    assert "<h2>How the search went</h2>" in dry_page
    after = dry_page.split("How the search went")[1]
    fitted = [entry for entry in dry.found.record if entry.gap is not None]
    assert after.count("<tr>") > len(fitted)
    assert all(name in after for entry in dry.found.record for name in entry.effects)
    assert "promises to stay far above what is at the noise floor" in after


def test_the_page_shows_parameters_limits_and_what_is_open(dry_page):
    assert "N mm / mm" in dry_page
    for title in ("Detection limits", "What these trials cannot tell", "Noise and numerical error"):
        assert f"<h2>{title}</h2>" in dry_page


def test_warnings_stand_in_boxes(dry, undrawn):
    warned = page(dry.found, {**dry.report, "warnings": ["mind the <gap>"], "parameters": {}})
    assert '<p class="warning">mind the &lt;gap&gt;</p>' in warned


def test_without_limits_there_is_no_heading_for_them(dry, undrawn):
    told = replace(dry.found.assessment, detection_limits={})
    assert "Detection limits" not in page(replace(dry.found, assessment=told), dry.report)


def test_the_next_experiment_stands_with_what_is_open(dry, undrawn):
    asked = page(dry.found, {**dry.report, "next_experiment": "turn slowly"})
    assert "<li>Next: turn slowly</li>" in asked
