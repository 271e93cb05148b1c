"""What messages share."""

import numpy as np

from diagnosis.log.checks.wording import lines, listed


def test_four_names_are_listed_and_the_others_counted():
    assert listed(["a", "b"]) == "a, b"
    assert listed({name: 1.0 for name in "abcdef"}) == "a, b, c, d and 2 more"


def test_rows_are_told_as_lines_of_the_file():
    rows = np.zeros(20, bool)
    rows[[0, 3, 4, 5, 19]] = True
    assert lines(rows) == "lines 2, 5-7, 21"
