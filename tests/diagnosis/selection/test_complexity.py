"""What an explanation has to take off the cost to be worth its freedom."""

import math

import pytest

from diagnosis.effects import FITTED
from diagnosis.selection.complexity import complexity_penalty

COUNT = len(FITTED)


@pytest.mark.parametrize(
    ("names", "freedom", "choices"),
    [
        ((), 0, 1),
        (("tip_drag",), 1, COUNT),
        (("stiction",), 3, COUNT),
        (("shear_thinning",), 1, COUNT),  # where its plateau begins is open and not told
        (("stiction", "tip_drag"), 4, COUNT * (COUNT - 1) / 2),
    ],
)
def test_freedom_costs_a_logarithm_and_so_does_the_choice(names, freedom, choices):
    expected = freedom * math.log(3000) + 2 * math.log(choices)
    assert complexity_penalty(names, 3000) == pytest.approx(expected)


def test_nothing_is_likelier_than_anything_before_the_data():
    """Without data, odds of all effects together are those of none: their number takes it back."""
    one = complexity_penalty(("tip_drag",), 1)
    assert COUNT * math.exp(-0.5 * (one - math.log(2))) == pytest.approx(1.0)
