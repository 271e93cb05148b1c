"""The page for people."""

from dataclasses import replace
from datetime import date
from itertools import pairwise

import pytest
from html_outline import HtmlOutline
from matplotlib.figure import Figure

from diagnosis.report import html_report
from diagnosis.report.answer import answer
from diagnosis.report.html_report import page
from diagnosis.report.sections import agreement, alternatives, front, limits, parameters

SECTIONS = [
    "Why to believe it",
    "Where the residual is",
    "Parameters",
    "What else it may be",
    "Detection limits",
    "How the search went",
    "Sensors and numerical error",
    "The rig and its trials",
]
MOST_BYTES = 1e6


@pytest.fixture(scope="session")
def dry_page(written):
    return (written / "report.html").read_text()


@pytest.fixture(scope="session")
def outline(dry_page):
    return HtmlOutline(dry_page)


@pytest.fixture
def undrawn(monkeypatch):
    """Pages without their pictures, which take half a second each."""
    for module in (agreement, alternatives, limits, parameters):
        for name in [n for n in vars(module) if n.startswith("draw_")]:
            monkeypatch.setattr(module, name, lambda *_: Figure())
    monkeypatch.setattr(html_report, "where_section", lambda _: [])


def test_the_page_starts_with_the_answer_in_three_sentences(dry_page, dry):
    what, sure, then = answer(dry.found)
    places = [dry_page.index(part) for part in (f"<h1>{what}</h1>", sure, then, "<nav", "<h2", "<img")]
    assert places == sorted(places)


def test_the_page_opens_without_a_network(dry_page, outline):
    assert "://" not in dry_page
    assert len(dry_page) < MOST_BYTES
    images = outline.attributes("img")
    assert len(images) == 8 + len({"trial_01", "trial_02", "trial_03"})
    assert all(own["src"].startswith("data:image/png;base64,") for own in images)
    assert not {"script", "link", "iframe", "object"} & {name for name, _ in outline.tags}


def test_the_sections_stand_in_the_order_in_which_they_are_asked_for(outline):
    assert [text for level, text in outline.headings if level == 2] == SECTIONS


def test_headings_go_down_one_level_at_a_time_and_there_is_one_of_the_first(outline):
    levels = [level for level, _ in outline.headings]
    assert levels.count(1) == 1
    assert all(after - before <= 1 for before, after in pairwise(levels))


def test_every_link_has_its_end_and_every_section_its_link(outline):
    ends = [own["href"].removeprefix("#") for own in outline.attributes("a")]
    assert len(outline.ids) == len(set(outline.ids))
    assert set(ends) <= set(outline.ids)
    assert len(ends) == 1 + len(SECTIONS)


def test_every_picture_is_told_in_words_with_numbers(outline):
    for own in outline.attributes("img"):
        assert len(own["alt"]) > 40
        assert any(c.isdigit() for c in own["alt"])


def test_tags_are_closed_in_order_and_tables_have_captions_and_scopes(outline):
    assert outline.unbalanced == []
    assert len(outline.attributes("caption")) == len(outline.attributes("table")) >= 6
    assert all(own.get("scope") in ("col", "row") for own in outline.attributes("th"))


def test_whatever_scrolls_can_be_reached_by_keyboard_and_has_a_name(outline):
    scrolling = [own for _, own in outline.tags if "scroll" in own.get("class", "")]
    assert len(scrolling) == len(outline.attributes("img")) + len(outline.attributes("table"))
    assert all(own["tabindex"] == "0" and own["aria-label"] for own in scrolling)


def test_the_head_names_log_and_day(dry, undrawn):
    log = replace(dry.found.log, name="run 7")
    found = replace(dry.found, log=log, diagnosed_on=date(2026, 2, 3))
    told = page(found, dry.report).text
    assert "log run 7, diagnosed on 2026-02-03, needle-torsion" in told
    assert "<title>run 7: gap report</title>" in told


def test_warnings_stand_in_boxes(dry, undrawn):
    warned = replace(dry.found, log=replace(dry.log, warnings=("mind the <gap>",)))
    assert '<p class="warning">mind the &lt;gap&gt;</p>' in page(warned, dry.report).text


def test_without_limits_there_is_no_heading_for_them(dry, undrawn):
    told = replace(dry.found.assessment, detection_limits={})
    assert 'id="detection-limits"' not in page(replace(dry.found, assessment=told), dry.report).text


def test_the_page_stands_without_a_picture_and_a_section_that_fail(dry, undrawn, monkeypatch):
    def fails(*_):
        raise ValueError("mathtext")

    monkeypatch.setattr(agreement, "draw_loops", fails)
    monkeypatch.setattr(html_report, "search_section", fails)
    made = page(dry.found, dry.report)
    assert made.lacks == (
        "the picture under 'Loops of torque and lag' (ValueError: mathtext)",
        "the section after 'Detection limits' (ValueError: mathtext)",
    )
    left = HtmlOutline(made.text)
    assert left.unbalanced == []
    told = [text for level, text in left.headings if level == 2]
    assert told == [s for s in SECTIONS if s not in ("Where the residual is", "How the search went")]


@pytest.mark.parametrize(
    ("part", "where", "left"),
    [
        ("answer", "after 'Gap report'", ["origin", "origin", "warning", "warning"]),
        ("_constants", "at the top", ["warning", "lead", "lead", "warning"]),
    ],
)
def test_the_page_stands_without_a_part_of_its_head(dry, undrawn, monkeypatch, part, where, left):
    def fails(*_):
        raise ValueError("no words")

    monkeypatch.setattr(front, part, fails)
    warned = replace(dry.found, log=replace(dry.log, warnings=("mind the gap",)))
    made = page(warned, dry.report)
    assert made.lacks == (f"the section {where} (ValueError: no words)",)
    outline = HtmlOutline(made.text)
    levels = [level for level, _ in outline.headings]
    assert levels[0] == 1
    assert levels.count(1) == 1
    assert [own["class"] for own in outline.attributes("p") if "class" in own][:4] == left
    assert next(text for level, text in outline.headings if level == 2) == SECTIONS[0]
