"""What free-form fits say of what is missing."""

import math
from dataclasses import replace

import numpy as np
import pytest
from free_forms import (
    CURVE,
    LEVEL,
    beside_another,
    family_of,
    fits_of_four,
    fitted_curve,
    free_fit,
    linear_fit,
)

from diagnosis.criteria.freeform import (
    CLOSED_GAP,
    FREE_LAW_GAIN,
    LEAST_WEIGHT,
    SECOND,
)
from diagnosis.effects.effect import Place
from diagnosis.freeform.fits.free_fit import FreeFit
from diagnosis.freeform.missing.missing import missing_of
from diagnosis.freeform.missing.places import probabilities_of_places


def test_a_law_beside_another_is_told_with_it_and_counts_for_its_place_by_half():
    found = missing_of([beside_another()], 5.0)
    assert (found.law.y, found.law.place) == ((2.0,), Place.TISSUE)
    assert [(law.y, law.place) for law in found.beside] == [((7.0,), Place.INTERFACE)]
    assert [(d.variable, d.gap_after) for d in found.depends_on] == [("time", 1.1), ("rate", 1.1)]
    assert found.place[Place.INTERFACE] / found.place[Place.TISSUE] == pytest.approx(
        (LEAST_WEIGHT + SECOND) / (LEAST_WEIGHT + 1.0)
    )


def test_variables_are_told_once_the_one_that_leaves_least_first():
    told = missing_of(fits_of_four(), 5.0).depends_on
    assert [(d.variable, d.gap_after) for d in told] == [
        ("direction", 1.02),
        ("torque", 1.2),
        ("time", 3.0),
    ]
    assert [d.place for d in told] == [Place.INTERFACE, Place.SENSOR, Place.TISSUE]


def test_after_the_best_variables_are_in_the_order_of_what_is_left():
    """Whether or not their laws were fitted to the log itself, and where there is no gap to tell."""
    more = [
        free_fit(math.inf, name="lost", says="rate"),
        free_fit(2.0, final=False, name="rough", says="depth"),
    ]
    told = missing_of([*fits_of_four(), *more], 5.0).depends_on
    assert [d.variable for d in told] == ["direction", "torque", "depth", "time", "rate"]
    assert [d.variable for d in told if d.decimated] == ["depth"]


def test_what_was_fitted_to_the_log_itself_comes_before_what_was_not():
    rough = free_fit(0.9, final=False, name="rough", says="time", places={Place.TISSUE: 1.0})
    found = missing_of([rough, *fits_of_four()[:1]], 5.0)
    assert found.best.family.name == "direction"
    assert [d.variable for d in found.depends_on] == ["direction", "time"]


def test_of_laws_that_were_fitted_to_the_decimated_log_alone_none_is_told():
    found = missing_of([free_fit(1.0, final=False)], 5.0)
    assert (found.law, found.closed) == (None, False)


@pytest.mark.parametrize(
    ("gap", "nearest", "helps", "closed"),
    [
        (1.02, 5.0, True, True),
        (CLOSED_GAP + 0.01, 5.0, True, False),
        (1.02, 1.02 / FREE_LAW_GAIN - 1e-6, False, False),
        (1.001, 1.042, True, True),
        (1.03, 1.042, False, False),
        (0.99, 1.02, False, False),
        (5.1, 5.0, False, False),
        (math.inf, 5.0, False, False),
    ],
)
def test_a_law_is_told_only_if_it_leaves_less_than_the_library(gap, nearest, helps, closed):
    curve = fitted_curve(np.zeros(CURVE.size), np.random.default_rng(0))
    rough = free_fit(3.0, final=False)
    found = missing_of([replace(curve, gap_after=gap), rough], nearest)
    assert ((found.law is not None), found.closed) == (helps, closed)
    assert found.best.gap_after == gap


@pytest.mark.parametrize("size", [0.5, -0.5])
def test_of_a_law_that_grows_both_variables_are_told_the_factor_behind_it(size):
    """The factor is a curve of the same effect, which the law before it is multiplied by; its median is
    1, and the law is as large as both together."""
    family = family_of(parameters=[LEVEL, LEVEL], curve=lambda level, _: ((0.0,), (level,)))
    factor = replace(
        family,
        says="depth",
        curve=lambda _, slope: ((0.0, 1.0, 2.0), tuple(slope * n for n in (3.0, 4.0, 5.0))),
        multiplies=True,
    )
    family = replace(family, factor=factor)
    fit = linear_fit(family, [np.eye(2)], [np.zeros(2)], x=[2.0, size])
    found = missing_of([FreeFit(family=family, fit=fit, gap_after=1.0, final=True)], 5.0)
    assert [one.variable for one in found.depends_on] == ["time", "depth"]
    assert (found.law.y, found.law.multiplies) == ((8.0 * size,), False)
    (told,) = found.beside
    assert (told.variable, told.y, told.multiplies) == ("depth", (0.75, 1.0, 1.25), True)
    for law in (found.law, told):
        assert all(low <= y <= high for low, y, high in zip(law.low, law.y, law.high, strict=True))


def test_of_one_trial_what_a_law_leaves_counts_once():
    found = missing_of(fits_of_four(), 5.0, one_trial=True)
    assert found.place == probabilities_of_places(fits_of_four(), 5.0, 0.5)
