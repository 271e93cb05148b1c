"""Grids and distributions."""

import numpy as np
import pytest

from models.errors import InvalidValue
from studies.campaign.variation import Variation


def draws(count=2000, **how):
    variation = Variation(**how)
    return np.array([variation.drawn(np.random.default_rng(i)) for i in range(count)])


def test_a_grid_is_its_values_and_a_range_is_even():
    assert Variation(grid=[3, 1]).steps == (3, 1)
    assert Variation(linspace=[0, 1, 3]).steps == (0.0, 0.5, 1.0)
    assert Variation(uniform=[0, 1]).steps is None


def test_draws_have_the_moments_of_their_distribution():
    """Within four standard errors of 2000 draws."""
    uniform, normal = draws(uniform=[2, 4]), draws(normal=[5, 2])
    logarithm = np.log10(draws(log_uniform=[1e-3, 1e-1]))
    assert abs(uniform.mean() - 3) < 4 * 2 / np.sqrt(12 * 2000)
    assert (uniform.min() >= 2) & (uniform.max() <= 4)
    assert abs(normal.mean() - 5) < 4 * 2 / np.sqrt(2000)
    assert abs(normal.std() - 2) < 4 * 2 / np.sqrt(2 * 2000)
    assert abs(logarithm.mean() + 2) < 4 * 2 / np.sqrt(12 * 2000)
    assert (logarithm.min() >= -3) & (logarithm.max() <= -1)


def test_a_choice_is_each_of_its_values_as_often():
    names = draws(choice=["chicken", "simtest"])
    assert abs((names == "chicken").mean() - 0.5) < 4 * 0.5 / np.sqrt(2000)


def test_what_has_to_be_possible():
    assert Variation(choice=["a", None]).support == ("a", None)
    assert Variation(log_uniform=[1, 2]).support == (1.0, 2.0)
    assert Variation(normal=[5, 2]).support == (5.0,)
    assert Variation(linspace=[0, 1, 2]).support == (0.0, 1.0)


@pytest.mark.parametrize(
    ("how", "named"),
    [
        ({}, "exactly one"),
        ({"grid": [1], "uniform": [0, 1]}, "exactly one"),
        ({"uniform": [1, 1]}, "uniform"),
        ({"log_uniform": [0, 1]}, "log_uniform"),
        ({"normal": [0, 0]}, "standard deviation"),
        ({"gird": [1]}, "'grid'"),
        ({"grid": []}, "grid"),
        ({"linspace": [0, 1]}, "linspace"),
    ],
)
def test_misuse_names_the_field(how, named):
    with pytest.raises(InvalidValue, match=named):
        Variation(**how)
