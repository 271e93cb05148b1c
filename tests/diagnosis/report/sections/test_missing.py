"""What is missing, on the page."""

from dataclasses import replace
from types import SimpleNamespace

from free_forms import LAW, free_fit, missing_with

from diagnosis.report.figures.law import describe_law
from diagnosis.report.sections import missing as section
from diagnosis.report.sections.missing import missing_section


def telling(missing):
    """What the section looks at of a diagnosis."""
    gap = SimpleNamespace(before=8.9)
    return SimpleNamespace(missing=missing, assessment=SimpleNamespace(gap=gap))


def test_where_no_law_was_looked_for_there_is_no_section():
    assert missing_section(telling(None)) == []


def test_the_law_is_drawn():
    parts = missing_section(telling(missing_with()))
    page = "".join(parts)
    assert "What is missing" in parts[0]
    assert page.count("<figure") == 1
    assert describe_law(LAW) in page


def test_every_law_that_was_fitted_is_drawn():
    other = replace(LAW, variable="time", title="stiffness of the tissue")
    found = missing_with(beside=(other,))
    found = replace(found, best=replace(found.best, others=(free_fit(1.0, name="other").family,)))
    page = "".join(missing_section(telling(found)))
    assert page.count("<figure") == 2
    assert page.index(describe_law(LAW)) < page.index(describe_law(other))


def test_where_no_law_helps_nothing_is_drawn(monkeypatch):
    monkeypatch.setattr(section, "draw_law", None)
    page = "".join(missing_section(telling(missing_with(law=None))))
    assert "<figure" not in page
    assert page.count("<table") == 2


def test_places_and_variables_are_ranked():
    page = "".join(missing_section(telling(missing_with())))
    order = ("between shaft and tissue</th><td>0.90", "at the drive</th><td>0.02")
    assert 0 < page.index(order[0]) < page.index(order[1])
    rows = page[page.index("What it depends on") :]
    assert rows.index("1.03") < rows.index("2.50")
    assert rows.count("<tr>") >= len(missing_with().depends_on)


def test_a_law_that_could_not_be_simulated_on_unseen_trials_has_no_number():
    rows = "".join(missing_section(telling(missing_with())))
    assert "<td>not simulated</td>" in rows
    assert "<td>inf</td>" not in rows


def test_a_gap_says_to_what_its_law_was_fitted():
    first, second, *_ = missing_with().depends_on
    told = replace(missing_with(), depends_on=(first, replace(second, decimated=True)))
    page = "".join(missing_section(telling(told)))
    assert "<td>1.03</td><td>full log</td>" in page
    assert "<td>2.50</td><td>decimated log</td>" in page
