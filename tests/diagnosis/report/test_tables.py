"""The tables of the page."""

import re
from dataclasses import replace

import pytest
from diagnosis_fixtures import scored

from diagnosis.assessment.detection_limits import DetectionLimit
from diagnosis.report.tables import (
    explanation_table,
    limit_in_words,
    limits_table,
    parameter_table,
    search_table,
)
from diagnosis.selection.record import dropped, failed, kept, not_fitted
from diagnosis.workers import Failure


def cells(table):
    """Rows of a table of plain text."""
    rows = re.findall(r"<tr>(.*?)</tr>", table)
    return [re.findall(r"<t[hd][^>]*>(.*?)</t[hd]>", row) for row in rows]


@pytest.mark.parametrize(
    ("effect", "values", "words"),
    [
        ("base_compliance", {"stiffness": 240.0}, "stiffness ≥ 240 N mm / rad"),
        ("tip_drag", {"damping": 0.02}, "damping ≤ 0.02 N mm s / rad"),
        ("tip_angle_bias", {"bias": -0.025}, "|bias| ≤ 0.025 deg"),
        ("tip_angle_scale", {"scale": 0.99}, "scale 0.9900 to 1.0101"),
        ("layered_tissue", {"ratio": 1.1, "boundary": 0.35}, "ratio 0.9091 to 1.1000, boundary 0.35"),
        ("inserted_offset", {"offset": 0.48781}, "|offset| ≤ 0.488 mm"),
        ("stiction", {}, "any strength"),
    ],
)
def test_a_limit_is_told_with_its_direction(effect, values, words):
    assert limit_in_words(effect, values) == words


def test_limits_are_a_row_for_each_effect():
    each = {"tip_drag": {"damping": 0.02}, "stiction": {}}
    limits = {effect: DetectionLimit(parameters=own) for effect, own in each.items()}
    expected = [["tip_drag", "damping ≤ 0.02 N mm s / rad"], ["stiction", "any strength"]]
    assert cells(limits_table(limits))[1:] == expected


def test_a_parameter_is_told_with_its_interval_and_unit():
    level = {"value": 0.0015, "low": 0.00148, "high": 0.00152, "unit": "N mm / mm"}
    row = cells(parameter_table({"coulomb_friction": {"level": level}}))[1]
    assert row == ["coulomb_friction", "level", "0.0015", "0.00148 to 0.00152", "N mm / mm"]


@pytest.mark.parametrize(
    ("interval", "told"),
    [
        ((1.02345, 1.02331, 1.02359), "1.0233 to 1.0236"),
        ((2.0, 2.0, 2.0), "2 to 2"),  # held at a bound
        ((0.1, -30.0, 30.0), "-30 to 30"),
    ],
)
def test_the_ends_of_an_interval_have_digits_that_tell_them_apart(interval, told):
    scale = dict(zip(("value", "low", "high"), interval, strict=True)) | {"unit": "-"}
    assert cells(parameter_table({"tip_angle_scale": {"scale": scale}}))[1][3] == told


def test_a_pair_is_one_row_at_its_probability_and_what_rounds_to_nothing_is_none(dry):
    sets = ((("torque_bias", "tip_drag"), 0.9), ((), 0.0999), (("stiction",), 0.0001))
    found = replace(dry.found, verdict=replace(dry.found.verdict, ranking=sets))
    rows = cells(explanation_table(found))[1:]
    assert rows == [["tip_drag + torque_bias", "0.900"], ["none", "0.100"]]


def test_every_decision_of_a_stage_is_a_row():
    record = (
        *kept("pairs", [scored([], 12.34)], "as rig.yaml says"),
        *not_fitted("pairs", [("tip_drag", "stiction")], "promises too little"),
        *failed("pairs", [Failure(effects=("stiction",), reason="a < b")]),
        *dropped("pairs", [scored(["tip_drag"], 20.0)], "others are better"),
    )
    rows = cells(search_table("pairs", record))[1:]
    assert rows[0] == ["nominal rig", "kept", "1.00", "12", "as rig.yaml says"]
    assert rows[1] == ["tip_drag + stiction", "dropped", "", "", "promises too little"]
    assert rows[2][1:] == ["failed", "", "", "a &lt; b"]
    assert len(rows) == 4


def test_what_was_not_fitted_for_one_reason_is_one_row_and_every_fit_has_its_own():
    few = not_fitted("pairs", [("tip_drag",), ("stiction",), ()], "promises too little")
    other = not_fitted("pairs", [("torque_bias",)], "another reason")
    fits = dropped("pairs", [scored(["tip_drag"], 20.0), scored(["stiction"], 21.0)], "far")
    rows = cells(search_table("pairs", (*few, *other, *fits)))[1:]
    assert [row[0] for row in rows] == [
        "tip_drag, stiction, nominal rig",
        "torque_bias",
        "tip_drag",
        "stiction",
    ]


def test_of_many_sets_the_first_are_named_and_the_others_counted_single_effects_all():
    names = [f"effect_{i}" for i in range(20)]
    sets = not_fitted("pairs", [("tip_drag", name) for name in names], "promises too little")
    alone = not_fitted("pairs", [(name,) for name in names], "screening promises too little")
    of_sets, of_single = cells(search_table("pairs", (*sets, *alone)))[1:]
    assert of_sets[0].endswith("tip_drag + effect_7 and 12 more")
    assert of_single[0] == ", ".join(names)
