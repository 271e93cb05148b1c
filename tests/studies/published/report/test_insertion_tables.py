"""Figs. 11 and 12 as a table and in sentences."""

import math
from dataclasses import replace

import pytest

from studies.published.insertion_study import InsertionStudy
from studies.published.report.insertion_tables import (
    insertion_sentences,
    insertion_table,
    value_or_basis,
)


@pytest.fixture(scope="module")
def insertions(study):
    return study.insertions


def test_the_nearest_hypothesis_comes_first_and_has_a_star(insertions):
    table = insertion_table(insertions)
    assert {len(row) for row in table.rows} == {len(table.head)}
    rms = [float(row[4]) for row in table.rows]
    assert rms == sorted(rms)
    assert [row[0].endswith("*") for row in table.rows] == [p.meets_both for p in insertions.predictions]
    stated = next(row for row in table.rows if row[0] == "stated")
    assert stated[1:4] == ("viscous, Table II", "6.5", "1.9")


def test_a_value_is_said_with_its_unit_and_what_set_it(insertions):
    fitted = next(p for p in insertions.predictions if p.hypothesis.name == "larger damping")
    assert value_or_basis(fitted) == "3.25 (set by 12 mm)"
    never = replace(fitted, value=math.nan)
    assert value_or_basis(never) == "none of 1 to 10 gives 12 mm"
    based = replace(fitted, hypothesis=replace(fitted.hypothesis, basis="here"))
    assert value_or_basis(based) == "3.25 (set by 12 mm); here"


def test_sentences_say_what_is_left_and_what_is_contradicted(insertions):
    said = "\n".join(insertion_sentences(insertions))
    assert "the stated model gives 6.5 mm and 1.9 mm" in said
    assert "would be 0.69 mm and 0.17 mm" in said
    assert "larger damping would miss those by far more" in said
    assert "Without such a contradiction: longer shaft, 330 mm" in said
    assert "330 mm of shaft: they do not explain Fig. 12 as well" in said
    assert "With base_servo and shear_thinning, prebent tip in the channel that it cuts" in said


def test_where_nothing_meets_both_deviations_that_is_said(insertions):
    stated = InsertionStudy(predictions=(insertions.stated,), one_way_mm=(0.7, 0.2))
    said = insertion_sentences(stated)
    assert "No hypothesis meets both deviations within 2 σ." in said
    assert not any("Tables II" in line or "Without any friction" in line for line in said)
