"""Probabilities of places, by what free-form laws leave."""

import math
from dataclasses import replace

import numpy as np
import pytest
from free_forms import (
    LEVEL,
    beside_another,
    family_of,
    fits_of_four,
    free_fit,
    linear_fit,
)

from diagnosis.criteria.freeform import (
    CHOICE,
    COMPANION,
    FLOOR,
    FREEDOM,
    LEAST_WEIGHT,
    PATIENCE,
)
from diagnosis.effects.effect import Place
from diagnosis.freeform.missing.places import likelier_first, probabilities_of_places


def test_no_place_is_likely_where_the_library_leaves_less_than_every_law():
    """The best law's weight is (1.02^2 - 0.9)^-10 / 0.1^-10 = 0.03 of the library's, shared by six."""
    place = probabilities_of_places(fits_of_four(), 1.02 / 1.2)
    assert max(place.values()) - min(place.values()) < 0.03


def test_places_are_probabilities_of_all_six():
    place = probabilities_of_places(fits_of_four(), 5.0)
    assert set(place) == set(Place)
    assert sum(place.values()) == pytest.approx(1.0)
    assert min(place.values()) > 0
    assert max(place, key=place.get) is Place.INTERFACE


def test_a_gap_that_is_larger_weighs_less_by_its_power():
    """Weights are 1 and a power of what is left beyond noise, shared as the family says."""
    place = probabilities_of_places(fits_of_four(), 5.0)
    weight = ((FLOOR + 1.2**2 - 1) / (FLOOR + 1.02**2 - 1)) ** (-1 / PATIENCE)
    assert place[Place.SENSOR] / place[Place.INTERFACE] == pytest.approx(
        (LEAST_WEIGHT + 0.6 * weight) / (LEAST_WEIGHT + 1.0)
    )
    assert place[Place.NEEDLE] / place[Place.INTERFACE] == pytest.approx(
        (LEAST_WEIGHT + 0.4 * weight) / (LEAST_WEIGHT + 1.0)
    )
    assert place[Place.DRIVE] == pytest.approx(place[Place.PARAMETERS])


@pytest.mark.parametrize(("gap", "more", "share"), [(10.0, 11.0, 1 / 7), (1.0, 1.02, 1 / 30)])
def test_far_above_the_noise_ten_percent_are_a_seventh_and_near_it_two_are_more(gap, more, share):
    here = free_fit(gap, name="here", says="time", places={Place.TISSUE: 1.0})
    there = free_fit(more, name="there", says="rate", places={Place.SENSOR: 1.0})
    place = probabilities_of_places([here, there], 50.0)
    ratio = (place[Place.SENSOR] - place[Place.DRIVE]) / (place[Place.TISSUE] - place[Place.DRIVE])
    assert ratio == pytest.approx(share, rel=0.1)


def test_of_one_trial_what_a_law_leaves_counts_once():
    here = free_fit(10.0, name="here", says="time", places={Place.TISSUE: 1.0})
    there = free_fit(11.0, name="there", says="rate", places={Place.SENSOR: 1.0})
    twice, once = (probabilities_of_places([here, there], 50.0, own) for own in (1.0, 0.5))
    odds = [
        (place[Place.SENSOR] - place[Place.DRIVE]) / (place[Place.TISSUE] - place[Place.DRIVE])
        for place in (twice, once)
    ]
    assert odds[1] == pytest.approx(np.sqrt(odds[0]), rel=0.01)


def test_what_a_law_leaves_on_its_own_trials_counts_as_much():
    """Where both predict an unseen trial alike, by chance, one that leaves 2 % more is a thirtieth."""
    each = [
        replace(
            free_fit(1.05, name=place, says="time", places={place: 1.0}),
            fit=linear_fit(family_of([LEVEL]), [np.eye(100, 1)], [np.full(100, gap)], x=[0.0]),
        )
        for place, gap in ((Place.TISSUE, 1.0), (Place.SENSOR, 1.02))
    ]
    place = probabilities_of_places(each, 50.0)
    ratio = (place[Place.SENSOR] - place[Place.DRIVE]) / (place[Place.TISSUE] - place[Place.DRIVE])
    assert ratio == pytest.approx(1 / 30, rel=0.1)


def test_far_above_the_noise_own_trials_weigh_no_more_than_unseen_ones():
    """Of two laws one leaves 10 % less on its own trials, the other 20 % less on unseen ones."""
    each = [
        replace(
            free_fit(unseen, name=place, says="time", places={place: 1.0}),
            fit=linear_fit(family_of([LEVEL]), [np.eye(100, 1)], [np.full(100, gap)], x=[0.0]),
        )
        for place, gap, unseen in ((Place.TISSUE, 4.4, 9.0), (Place.SENSOR, 4.9, 7.2))
    ]
    place = probabilities_of_places(each, 50.0)
    assert max(place, key=place.get) is Place.SENSOR


def test_freedom_that_the_data_determine_costs():
    alike = {"says": "time", "places": {Place.TISSUE: 1.0}}
    simple, free = free_fit(1.1, **alike), free_fit(1.1, freedom=6, name="free")
    place = probabilities_of_places([simple, free], 5.0)
    assert place[Place.INTERFACE] / place[Place.TISSUE] == pytest.approx(
        (LEAST_WEIGHT + math.exp(-5 / FREEDOM)) / (LEAST_WEIGHT + 1.0)
    )


def test_the_choice_of_a_plain_law_costs():
    curve = free_fit(1.1, says="time", places={Place.TISSUE: 1.0})
    plain = free_fit(1.1, says="rate", places={Place.INTERFACE: 1.0})
    plain = replace(plain, family=replace(plain.family, shape="step"))
    place = probabilities_of_places([curve, plain], 5.0)
    assert place[Place.INTERFACE] / place[Place.TISSUE] == pytest.approx(
        (LEAST_WEIGHT + math.exp(-CHOICE / FREEDOM)) / (LEAST_WEIGHT + 1.0)
    )


def test_a_law_more_costs_its_parameters_and_what_a_second_thing_costs():
    alone = free_fit(1.1, name="alone", says="depth", places={Place.DRIVE: 1.0})
    place = probabilities_of_places([alone, beside_another()], 5.0)
    assert place[Place.TISSUE] / place[Place.DRIVE] == pytest.approx(
        (LEAST_WEIGHT + math.exp(-(1 + COMPANION) / FREEDOM)) / (LEAST_WEIGHT + 1.0)
    )


def test_of_laws_that_leave_as_little_the_one_whose_place_is_sure_comes_first():
    """The same gap, of families that differ in their places alone; 20 % less outweighs that."""
    sure = free_fit(1.01, places={Place.SENSOR: 1.0})
    either = {Place.DRIVE: 0.5, Place.SENSOR: 0.5}
    open_ = free_fit(1.01, places=either)
    assert likelier_first([open_, sure]) == [sure, open_]
    worse = free_fit(1.2, places={Place.SENSOR: 1.0})
    assert likelier_first([worse, open_]) == [open_, worse]
