"""A family of free-form laws."""

import math

import numpy as np
import pytest
from free_forms import CURVE, LEVEL, covered, family_of

from diagnosis.effects.effect import Place
from diagnosis.freeform.families import families_of
from diagnosis.freeform.family import FARTHEST, coordinates, coordinates_of, kind_of
from diagnosis.freeform.smooth_curve import smooth_curve


def test_coordinates_start_at_zero_with_a_prior_of_their_size():
    own = coordinates(1, 2, 0.5)
    assert [p.name for p in own] == ["straight 0", "rest 0", "rest 1"]
    for p in own:
        assert (p.start, p.scale, p.prior_sigma) == ((0.0,), 0.5, 1.0)
        assert p.to_fit(p.high) == FARTHEST == -p.to_fit(p.low)
    assert len(coordinates_of(smooth_curve(0.0, 1.0, 8))) == 8


def test_the_detail_of_a_curve_comes_last_and_is_not_fine():
    """Fine coordinates are left out of first fits: those of the rest that hardly change the curve."""
    usual, finer = (coordinates_of(curve) for curve in (CURVE, CURVE.finer))
    assert [p.fine for p in finer[: len(usual)]] == [p.fine for p in usual]
    assert any(p.fine for p in usual)
    detail = finer[len(usual) :]
    assert [kind_of(p) for p in detail] == ["detail"] * 7
    assert not any(p.fine for p in detail)


def test_a_parameter_that_is_no_coordinate_has_no_kind():
    kinds = [kind_of(p) for p in (*coordinates(1, 1, detail=2), LEVEL)]
    assert kinds == ["straight", "rest", "detail", "detail", ""]


def test_other_priors_are_those_of_the_coordinates_alone():
    family = family_of(parameters=[LEVEL, *coordinates(1, 2)])
    family = family.with_prior({"straight": 3.0, "rest": 0.2})
    assert [p.prior_sigma for p in family.effect.parameters] == [math.inf, 3.0, 0.2, 0.2]


def test_a_family_is_where_it_most_likely_lives():
    family = family_of(places={Place.SENSOR: 0.4, Place.NEEDLE: 0.6}, name="twist")
    assert (family.place, family.name) == (Place.NEEDLE, "twist")


TURNS = np.concatenate([np.linspace(0, 400, 300), np.linspace(400, -200, 400)])
SEEN = (0.5 * TURNS, 0.005 * TURNS)
FAMILIES = families_of(covered(TURNS, tip=0.9 * TURNS, torque=0.01 * TURNS, speed=2.0, seen=SEEN))


@pytest.mark.parametrize("family", FAMILIES, ids=lambda family: family.name)
def test_whatever_a_family_allows_may_be_weakened(family):
    """A screening weakens what it found: the result is a number within the bounds, also at these."""
    for p in family.effect.parameters:
        for value in (p.low, p.high, *p.start):
            weaker = p.towards_neutral(value, 0.3)
            assert isinstance(weaker, float)
            assert min(p.low, p.neutral or 0.0) <= weaker
            assert math.isinf(p.neutral or 0.0) or weaker <= max(p.high, p.neutral or 0.0)
