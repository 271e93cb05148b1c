"""Sets of columns that add up to a target, on columns whose sets are known."""

import numpy as np
import pytest

from diagnosis.selection.equivalence.column_sets import beside, combinations_within

RNG = np.random.default_rng(3)
FREE = np.zeros(5, bool)


@pytest.fixture
def columns():
    """Five columns: the third is the sum of the first two, the others are unrelated."""
    found = RNG.normal(size=(400, 5))
    found[:, 2] = found[:, 0] + found[:, 1]
    return found


def sets(found):
    return [one.columns for one in found]


def test_the_sets_that_add_up_are_found_with_their_amounts(columns):
    found = combinations_within(0.1 * columns[:, 2], columns, FREE, 3, allowed=1e-6)
    assert sets(found) == [(2,), (0, 1)]
    np.testing.assert_allclose(found[0].amounts, [0.1], rtol=1e-6)
    np.testing.assert_allclose(found[1].amounts, [0.1, 0.1], rtol=1e-6)
    assert all(one.cost < 1e-6 for one in found)


def test_a_column_is_not_in_a_set_that_does_without_it(columns):
    """A column that takes a little more off a small rest is no part of an explanation."""
    target = columns[:, 2] + 0.01 * columns[:, 3]
    found = combinations_within(target, columns, FREE, 2, allowed=1.0)
    assert (2,) in sets(found)
    assert (2, 4) not in sets(found)


def test_what_nothing_adds_up_to_has_no_sets(columns):
    """Negative control."""
    target = RNG.normal(size=400)
    assert combinations_within(target, columns, FREE, 3, allowed=0.5 * target @ target) == []


def test_what_cannot_be_negative_takes_no_part_in_a_difference(columns):
    target = columns[:, 2] - columns[:, 0]  # the second column, and a difference of two
    assert sets(combinations_within(target, columns, FREE, 2, 1e-6)) == [(1,), (0, 2)]
    one_sided = np.array([True, False, False, False, False])
    assert sets(combinations_within(target, columns, one_sided, 2, 1e-6)) == [(1,)]


def test_nuisance_takes_its_direction_out_at_the_cost_of_its_prior():
    slope, other = np.zeros(50), np.zeros(50)
    slope[0], other[1] = 10.0, 1.0
    target = (3 * slope + other)[:, None]
    free = beside(slope[:, None], np.array([1e-6]), target)[:, 0]
    assert free @ free == pytest.approx(1.0, abs=1e-6)
    # |10 (3 - a)|^2 + a^2 / s^2 is least 30^2 / (1 + 100 s^2).
    held = beside(slope[:, None], np.array([1 / 0.1]), target)[:, 0]
    assert held @ held == pytest.approx(1.0 + 900 / 2)


def test_without_nuisance_nothing_is_taken_out():
    columns = RNG.normal(size=(20, 3))
    np.testing.assert_array_equal(beside(np.zeros((20, 0)), np.zeros(0), columns), columns)
