"""A family of free-form laws."""

import math

from free_forms import LEVEL, family_of

from diagnosis.effects.effect import Place
from diagnosis.freeform.family import FARTHEST, coordinates, coordinates_of, kind_of
from diagnosis.freeform.smooth_curve import smooth_curve


def test_coordinates_start_at_zero_with_a_prior_of_their_size():
    own = coordinates(1, 2, 0.5)
    assert [p.name for p in own] == ["straight 0", "rest 0", "rest 1"]
    for p in own:
        assert (p.start, p.scale, p.prior_sigma) == ((0.0,), 0.5, 1.0)
        assert p.to_fit(p.high) == FARTHEST == -p.to_fit(p.low)
    assert len(coordinates_of(smooth_curve(0.0, 1.0, 8))) == 8


def test_a_parameter_that_is_no_coordinate_has_no_kind():
    assert [kind_of(p) for p in (*coordinates(1, 1), LEVEL)] == ["straight", "rest", ""]


def test_other_priors_are_those_of_the_coordinates_alone():
    family = family_of(parameters=[LEVEL, *coordinates(1, 2)]).with_prior(3.0, 0.2)
    assert [p.prior_sigma for p in family.effect.parameters] == [math.inf, 3.0, 0.2, 0.2]


def test_a_family_is_where_it_most_likely_lives():
    family = family_of(places={Place.SENSOR: 0.4, Place.NEEDLE: 0.6}, name="twist")
    assert (family.place, family.name) == (Place.NEEDLE, "twist")
