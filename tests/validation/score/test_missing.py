"""What a report of `unknown` says of what is missing, against the ground truth."""

import math

import pandas as pd
import pytest
from rich.console import Console

from scripts.blind import _missing, _percent
from scripts.tables import print_table
from validation.score.missing import CLOSED, missing_scores, missing_summary

ANSWER = {
    "verdict": "unknown",
    "outside": "drive_creep",
    "missing": {"place": ["drive", "sensor"], "variables": ["time", "event"]},
}


def said(place, *laws):
    depends_on = [{"variable": name, "gap_after": gap} for name, gap in laws]
    return {"verdict": "unknown", "missing": {"place": place, "depends_on": depends_on}}


@pytest.mark.parametrize(
    ("report", "right"),
    [
        (said({"drive": 0.6, "needle": 0.4}, ("time", 1.02), ("rate", 1.4)), (True, True, True)),
        (said({"drive": 0.2, "sensor": 0.8}, ("event", CLOSED)), (True, True, True)),
        (said({"drive": 0.4, "needle": 0.6}, ("time", 1.2)), (False, True, False)),
        (said({"drive": 0.6}, ("rate", 1.02), ("time", 1.01)), (True, False, True)),
        (said({"drive": 0.6}, ("time", None)), (True, True, False)),
        (said({}), (False, False, False)),
    ],
)
def test_the_first_place_and_variable_count_and_what_their_law_leaves(report, right):
    row = missing_scores(ANSWER, report)
    found = row["missing_place_right"], row["missing_variable_right"], row["missing_closed"]
    assert found == right
    assert row["missing_said"]


def test_older_reports_say_nothing_and_are_not_right():
    row = missing_scores(ANSWER, {"verdict": "unknown"})
    assert row["missing_told"]
    assert not any(row[f"missing_{n}"] for n in ("said", "place_right", "variable_right", "closed"))
    assert (row["missing_place"], row["missing_variable"]) == ("", "")
    assert math.isnan(row["missing_gap"])


def test_older_answers_say_nothing_and_nothing_is_right():
    row = missing_scores({"verdict": "unknown"}, said({"drive": 1.0}, ("time", 1.0)))
    assert row["missing_said"]
    assert not any(row[f"missing_{n}"] for n in ("told", "place_right", "variable_right", "closed"))


@pytest.fixture
def scores():
    """Four logs from outside, of which one has an older report and one an older answer; two others."""
    right = said({"drive": 1.0}, ("time", 1.0))
    rows = [
        ("unknown", missing_scores(ANSWER, right)),
        ("unknown", missing_scores(ANSWER, said({"needle": 1.0}, ("time", 1.5)))),
        ("unknown", missing_scores(ANSWER, {"verdict": "unknown"})),
        ("unknown", missing_scores({}, right)),
        ("none", missing_scores({}, {"verdict": "none"})),
        ("explained", missing_scores({}, right)),
    ]
    return pd.DataFrame([{"expected": expected, **row} for expected, row in rows])


def test_reports_are_counted_of_those_that_say_something(scores):
    assert missing_summary(scores) == {
        "said": (2, 3),
        "place_right": (1, 2),
        "variable_right": (2, 2),
        "closed": (1, 2),
        "elsewhere": (1, 2),
    }


def test_a_set_without_such_logs_counts_none(scores):
    assert set(missing_summary(scores[scores["expected"] == "none"]).values()) == {(0, 0), (0, 1)}


@pytest.mark.parametrize("width", [60, 80])
def test_the_table_fits_a_narrow_screen(scores, width, capsys):
    print_table(Console(width=width), _missing(scores))
    printed = capsys.readouterr().out
    assert max(map(len, printed.splitlines())) <= width
    words = " ".join(printed.split())
    for part in ("2 of 3", "1 of 2", "50.0 %", "100.0 %", "66.7 %"):
        assert part in words


@pytest.mark.parametrize(("share", "shown"), [(0.9731, "97.3 %"), (0.0, "0.0 %"), (math.nan, "–")])
def test_a_share_of_none_is_no_number(share, shown):
    assert _percent(share) == shown
