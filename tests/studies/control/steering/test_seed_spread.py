"""Median and range over seeds, some of which never get there."""

import math

import pytest

from studies.control.steering.seed_spread import Spread


@pytest.mark.parametrize(
    ("values", "expected"),
    [
        ([3, 1, 2], (2, 1, 3)),
        ([3, 1, math.nan], (3, 1, math.nan)),
        ([math.nan, 1, math.nan], (math.nan, 1, math.nan)),
        ([1, 2, 3, math.nan], (2.5, 1, math.nan)),
    ],
)
def test_never_ranks_after_every_number(values, expected):
    spread = Spread.of(values)
    assert (spread.median, spread.least, spread.largest) == pytest.approx(expected, nan_ok=True)
