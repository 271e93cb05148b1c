"""Checks, comparisons and poles, and their plain values."""

import json
import math

import pytest

from studies.crosscheck.findings import Check, Comparison, Findings, Pole, PoleSource


def test_a_check_fails_outside_its_bounds_and_on_nan():
    assert Check(name="x", value=1.0, unit="-", low=0, high=1).passed
    assert not Check(name="x", value=1.1, unit="-", high=1).passed
    assert not Check(name="x", value=math.nan, unit="-", high=1).passed


@pytest.mark.parametrize(
    ("bounds", "shown"),
    [({"high": 1}, "<= 1"), ({"low": 2}, ">= 2"), ({"low": 0.5, "high": 1.5}, "0.5 .. 1.5")],
)
def test_bounds_are_shown_as_a_person_writes_them(bounds, shown):
    assert Check(name="x", value=1.0, unit="-", **bounds).bounds == shown


def test_one_failed_check_fails_the_findings_and_comparisons_never_do():
    good, bad = (Check(name="x", value=v, unit="-", high=1) for v in (0.5, 1.5))
    far = Comparison(item="i", published=1.0, ours=9.0, unit="s", source="here")
    assert Findings(checks=[good], comparisons=[far]).passed
    assert not Findings(checks=[good, bad]).passed


def test_a_ratio_to_nothing_does_not_exist_and_is_null_in_json():
    nothing = Comparison(item="i", published=0.0, ours=9.0, unit="s", source="here")
    assert math.isnan(nothing.ratio)
    assert Findings(comparisons=[nothing]).as_json()["comparisons"][0]["ratio"] is None


POLE = Pole(
    length_mm=50,
    free_mm=0,
    drive="angle",
    mode=1,
    measured=-1.006,
    closed_form=-1.0,
    source=PoleSource.FIRST_ORDER,
    bound=0.015,
)


def test_the_error_of_a_pole_is_relative():
    assert POLE.error == pytest.approx(0.006)


def test_every_pole_says_its_source_as_a_plain_word():
    assert (
        json.loads(json.dumps(Findings(poles=[POLE]).as_json()))["poles"][0]["source"] == "first_order"
    )
    assert [source.words for source in PoleSource] == [
        "second order",
        "first order",
        "without callbacks",
    ]


def test_a_notebook_shows_every_bound_and_whether_it_holds():
    good, bad = (Check(name=f"<{v}>", value=v, unit="-", high=1) for v in (0.5, 1.5))
    assert "every bound holds" in Findings(checks=[good])._repr_html_()
    shown = Findings(checks=[good, bad])._repr_html_()
    assert "a bound fails" in shown
    assert all(
        text in shown for text in ("&lt;0.5&gt;", "&lt;1.5&gt;", "<td>holds</td>", "<td>fails</td>")
    )
