"""Columns that may be the angle of the tip, told and not chosen."""

import numpy as np
import pytest

from diagnosis.lab_files.guesses.guessed import GuessedColumn
from diagnosis.lab_files.guesses.tip_candidates import tip_candidates
from diagnosis.lab_files.mapping import ColumnSource
from diagnosis.lab_files.readers.lab_table import LabTable

TIME = np.arange(0, 10, 0.01)
BASE = np.sin(TIME)


def guess(wanted, column, **source):
    return GuessedColumn(
        wanted=wanted, source=ColumnSource(column=column, **source), reasons={}, known=True
    )


def candidates(*guesses, **columns):
    table = LabTable(title="run.csv", columns={"back encoder": BASE, **columns})
    guesses = guesses or (guess("base_angle_deg", "back encoder"),)
    return tip_candidates(guesses, [table], columns)


@pytest.mark.parametrize("sign", [1, -1])
def test_a_second_encoder_that_lags_behind_the_base_is_told_with_its_sign(sign):
    (found,) = candidates(**{"front encoder [counts]": 40 * sign * np.sin(TIME - 0.2)})
    assert (found.column, found.unit, found.sign) == ("front encoder [counts]", "counts", sign)
    assert found.reason.endswith("is it at the tip?")


@pytest.mark.parametrize(
    ("name", "values"),
    [
        ("front encoder", np.cos(TIME)),
        ("front encoder", np.zeros(TIME.size)),
        ("motor target", BASE),
        ("motor position (mm)", BASE),
        ("torque", BASE),
    ],
)
def test_what_turns_otherwise_or_is_called_otherwise_is_not_told(name, values):
    assert candidates(**{name: values}) == ()


def test_beside_a_tip_or_a_rate_of_the_base_nothing_is_told():
    base = guess("base_angle_deg", "back encoder")
    other = {"front encoder": BASE}
    assert len(candidates(base, **other)) == 1
    assert candidates(base, guess("tip_angle_deg", "camera"), **other) == ()
    assert candidates(guess("base_angle_deg", "back encoder", derive="integrate"), **other) == ()
