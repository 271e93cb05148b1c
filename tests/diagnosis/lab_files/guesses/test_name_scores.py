"""Words of names, and their weights."""

import numpy as np
import pytest

from diagnosis.criteria.lab_files import NAME_LEAST_SCORE
from diagnosis.lab_files.guesses.name_scores import (
    all_words,
    has_word,
    is_called_an_angle,
    score_of,
    span_of,
    weight_of,
)
from diagnosis.lab_files.readers.lab_table import LabTable


def table_of(*names, words=None):
    columns = {name: np.arange(5.0) for name in names}
    return LabTable(title="run.csv", columns=columns, words=words or {})


def test_a_star_stands_for_any_end_and_numbers_do_not_count():
    assert has_word(["encoder2"], "enc*")
    assert has_word(["tau3"], "tau")
    assert not has_word(["taught"], "tau")
    assert weight_of(["torque", "load"], {"load": 2, "torq*": 4}) == 4


def test_the_words_of_a_joint_count_and_volts_do_not():
    table = table_of("position[0]", "Force V", words={"position[0]": "needle_tip"})
    assert all_words(table, "position[0]") == ["position", "0", "needle", "tip"]
    assert all_words(table, "Force V") == ["force"]


@pytest.mark.parametrize(
    ("name", "angle"),
    [
        ("front encoder [counts]", True),
        ("hub angle (deg)", True),
        ("motor pos target", False),
        ("motor position (mm)", False),
        ("motor torque", False),
        ("temperature", False),
    ],
)
def test_an_angle_is_measured_and_in_no_unit_of_anything_else(name, angle):
    assert is_called_an_angle(table_of(name), name) == angle


def test_a_column_that_stands_still_is_less_likely_the_base():
    moving = table_of("motor angle")
    still = LabTable(title="run.csv", columns={"motor angle": np.zeros(5)})
    scores = [score_of("base_angle_deg", table, "motor angle") for table in (moving, still)]
    assert scores[0] > scores[1]
    assert scores[0] > NAME_LEAST_SCORE
    assert span_of(np.array([np.nan, 1.0, 3.0])) == 2
