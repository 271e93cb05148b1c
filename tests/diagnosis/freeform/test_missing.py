"""What free-form fits say of what is missing."""

import math
from dataclasses import replace

import numpy as np
import pytest
from free_forms import CURVE, LEVEL, family_of, free_fit, linear_fit

from diagnosis.criteria.freeform import CLOSED_GAP, FREE_LAW_GAIN
from diagnosis.effects import LIBRARY
from diagnosis.effects.effect import Place
from diagnosis.freeform.family import VISCOUS
from diagnosis.freeform.fits.free_fit import FreeFit
from diagnosis.freeform.missing import (
    CHOICE,
    COMPANION,
    FLOOR,
    FREEDOM,
    LEAST_WEIGHT,
    PATIENCE,
    SECOND,
    _told,
    missing_of,
)

TIP = {Place.SENSOR: 0.6, Place.NEEDLE: 0.4}


def fits():
    return [
        free_fit(1.02, name="direction", says="direction", places={Place.INTERFACE: 1.0}),
        free_fit(1.2, name="tip", says="torque", places=TIP),
        free_fit(3.0, name="time", says="time", places={Place.TISSUE: 1.0}),
        free_fit(3.5, name="other time", says="time", places={Place.INTERFACE: 1.0}),
    ]


def test_no_place_is_likely_where_the_library_leaves_less_than_every_law():
    """The best law's weight is (1.02^2 - 0.9)^-10 / 0.1^-10 = 0.03 of the library's, shared by six."""
    place = missing_of(fits(), 1.02 / 1.2).place
    assert max(place.values()) - min(place.values()) < 0.03


def test_places_are_probabilities_of_all_six():
    place = missing_of(fits(), 5.0).place
    assert set(place) == set(Place)
    assert sum(place.values()) == pytest.approx(1.0)
    assert min(place.values()) > 0
    assert max(place, key=place.get) is Place.INTERFACE


def test_a_gap_that_is_larger_weighs_less_by_its_power():
    """Weights are 1 and a power of what is left beyond noise, shared as the family says."""
    place = missing_of(fits(), 5.0).place
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
    place = missing_of([here, there], 50.0).place
    ratio = (place[Place.SENSOR] - place[Place.DRIVE]) / (place[Place.TISSUE] - place[Place.DRIVE])
    assert ratio == pytest.approx(share, rel=0.1)


def test_of_one_trial_what_a_law_leaves_counts_once():
    here = free_fit(10.0, name="here", says="time", places={Place.TISSUE: 1.0})
    there = free_fit(11.0, name="there", says="rate", places={Place.SENSOR: 1.0})
    twice, once = (missing_of([here, there], 50.0, one_trial=own).place for own in (False, True))
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
    place = missing_of(each, 50.0).place
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
    place = missing_of(each, 50.0).place
    assert max(place, key=place.get) is Place.SENSOR


def test_freedom_that_the_data_determine_costs():
    alike = {"says": "time", "places": {Place.TISSUE: 1.0}}
    simple, free = free_fit(1.1, **alike), free_fit(1.1, freedom=6, name="free")
    place = missing_of([simple, free], 5.0).place
    assert place[Place.INTERFACE] / place[Place.TISSUE] == pytest.approx(
        (LEAST_WEIGHT + math.exp(-5 / FREEDOM)) / (LEAST_WEIGHT + 1.0)
    )


def test_the_choice_of_a_plain_law_costs():
    curve = free_fit(1.1, says="time", places={Place.TISSUE: 1.0})
    plain = free_fit(1.1, says="rate", places={Place.INTERFACE: 1.0})
    plain = replace(plain, family=replace(plain.family, shape="step"))
    place = missing_of([curve, plain], 5.0).place
    assert place[Place.INTERFACE] / place[Place.TISSUE] == pytest.approx(
        (LEAST_WEIGHT + math.exp(-CHOICE / FREEDOM)) / (LEAST_WEIGHT + 1.0)
    )


def beside_another(gap=1.1):
    """The fit of a law in the tissue, over time, with another along the shaft, over the rate."""
    one = free_fit(gap, says="time", places={Place.TISSUE: 1.0})
    level = replace(LEVEL, name="level 0")
    other = family_of(parameters=[level], curve=lambda v: ((0.0,), (v,)), says="rate", name="other")
    fit = linear_fit(one.family, [np.eye(2)], [np.zeros(2)], x=[2.0, 7.0], beside=(other.effect,))
    return replace(one, fit=fit, others=(other,))


def test_a_law_beside_another_is_told_with_it_and_counts_for_its_place_by_half():
    found = missing_of([beside_another()], 5.0)
    assert (found.law.y, found.law.place) == ((2.0,), Place.TISSUE)
    assert [(law.y, law.place) for law in found.beside] == [((7.0,), Place.INTERFACE)]
    assert [(d.variable, d.gap_after) for d in found.depends_on] == [("time", 1.1), ("rate", 1.1)]
    assert found.place[Place.INTERFACE] / found.place[Place.TISSUE] == pytest.approx(
        (LEAST_WEIGHT + SECOND) / (LEAST_WEIGHT + 1.0)
    )


def test_a_law_more_costs_its_parameters_and_what_a_second_thing_costs():
    alone = free_fit(1.1, name="alone", says="depth", places={Place.DRIVE: 1.0})
    place = missing_of([alone, beside_another()], 5.0).place
    assert place[Place.TISSUE] / place[Place.DRIVE] == pytest.approx(
        (LEAST_WEIGHT + math.exp(-(1 + COMPANION) / FREEDOM)) / (LEAST_WEIGHT + 1.0)
    )


def test_variables_are_told_once_the_one_that_leaves_least_first():
    told = missing_of(fits(), 5.0).depends_on
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
    told = missing_of([*fits(), *more], 5.0).depends_on
    assert [d.variable for d in told] == ["direction", "torque", "depth", "time", "rate"]
    assert [d.variable for d in told if d.decimated] == ["depth"]


def test_what_was_fitted_to_the_log_itself_comes_before_what_was_not():
    rough = free_fit(0.9, final=False, name="rough", says="time", places={Place.TISSUE: 1.0})
    found = missing_of([rough, *fits()[:1]], 5.0)
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


def fitted_curve(truth, rng, noise=1.0):
    """A curve fitted to 60 readings at random places of it, and noise."""
    family = family_of(name="curve", says="depth", places={Place.SENSOR: 1.0})
    at = rng.uniform(0, 1, 60)
    slopes = np.stack([np.interp(at, CURVE.places, column) for column in CURVE.basis.T], axis=1)
    readings = slopes @ truth + rng.normal(0, noise, at.size)
    fit = linear_fit(family, [slopes], [readings])
    return FreeFit(family=family, fit=fit, gap_after=1.0, final=True)


def law_of(fit):
    return missing_of([fit], 5.0).law


def test_a_law_is_the_curve_of_its_fit_between_the_ends_of_its_band():
    rng = np.random.default_rng(3)
    one = fitted_curve(rng.normal(size=CURVE.size), rng)
    law = law_of(one)
    assert (law.place, law.variable, law.unit, law.x_unit) == (Place.SENSOR, "depth", "-", "s")
    np.testing.assert_allclose(law.x, CURVE.places)
    np.testing.assert_allclose(law.y, CURVE.basis @ one.fit.x)
    assert all(low < y < high for low, y, high in zip(law.low, law.y, law.high, strict=True))


def test_the_band_has_the_width_of_the_covariance():
    """1.96 standard deviations; quantiles of 400 draws are known to 0.13 of one."""
    rng = np.random.default_rng(8)
    one = fitted_curve(np.zeros(CURVE.size), rng)
    (slopes,) = one.fit.jacobian
    loud = max(1.0, one.fit.gap) ** 2
    covariance = np.linalg.inv(slopes.T @ slopes / loud + np.eye(CURVE.size))
    sigma = np.sqrt(np.diag(CURVE.basis @ covariance @ CURVE.basis.T))
    law = law_of(one)
    np.testing.assert_allclose((np.array(law.high) - law.y) / sigma, 1.96, atol=4 * 0.13)
    np.testing.assert_allclose((law.y - np.array(law.low)) / sigma, 1.96, atol=4 * 0.13)


def test_a_band_holds_the_truth_in_95_of_100():
    """Of truths that are as likely as the prior says; one place of each of 120 fits."""
    rng = np.random.default_rng(11)
    held, shifted, count = 0, 0, 120
    for i in range(count):
        truth = rng.normal(size=CURVE.size)
        law, at = law_of(fitted_curve(truth, rng)), i % CURVE.size
        real = float(CURVE.basis[at] @ truth)
        held += law.low[at] <= real <= law.high[at]
        shifted += law.low[at] <= real + (law.high[at] - law.low[at]) <= law.high[at]
    assert held / count >= 0.95 - 3.5 * math.sqrt(0.95 * 0.05 / count)
    assert shifted / count < 0.2  # a law off by the width of its band is out of most


def test_a_band_stays_within_the_bounds_of_its_parameters():
    bounded = replace(LEVEL, low=0.0, high=0.2)
    family = family_of(parameters=[bounded], curve=lambda level: ((0.0, 1.0), (level, level)))
    fit = linear_fit(family, [np.eye(1)], [np.zeros(1)], x=[0.1])
    law = law_of(FreeFit(family=family, fit=fit, gap_after=1.0, final=True))
    assert (law.low[0], law.high[0]) == (0.0, 0.2)


def test_a_level_of_nearly_nothing_has_a_band_in_its_own_unit():
    """Its logarithm is open by 25, and yet 0.001 would have changed the readings by 40 sigma."""
    level = replace(LEVEL, low=1e-6, high=0.05, logarithmic=True, start=(1e-3,))
    family = family_of(parameters=[level], curve=lambda level: ((0.0, 1.0), (level, level)))
    x = [np.log(1e-6)]
    fit = linear_fit(family, [np.array([[1.0 / 25.0]])], [np.array([x[0] / 25.0])], x=x)
    law = law_of(FreeFit(family=family, fit=fit, gap_after=1.0, final=True))
    assert law.low[0] == pytest.approx(1e-6)
    assert law.high[0] == pytest.approx(1e-6 * (1.0 + 1.96 * 25.0), rel=0.15)


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("seed", range(10))
def test_a_law_of_which_the_data_tell_much_and_nothing_has_a_band(seed):
    """Slopes over eleven decades, two of them alike: the covariance is singular to rounding."""
    rng = np.random.default_rng(seed)
    slopes = rng.normal(size=(300, CURVE.size)) * 10.0 ** rng.uniform(-6, 5, CURVE.size)
    slopes[:, 3] = slopes[:, 4] * (1 + 1e-9)
    family = family_of()
    fit = linear_fit(family, [slopes], [np.zeros(300)], x=np.zeros(CURVE.size))
    law = law_of(FreeFit(family=family, fit=fit, gap_after=1.0, final=True))
    assert np.isfinite([*law.low, *law.high]).all()
    assert all(low <= high for low, high in zip(law.low, law.high, strict=True))


def test_the_curve_is_of_its_own_parameters_and_names_what_is_beside_it():
    other = replace(family_of().effect, name="tip_drag", parameters=(LEVEL,))
    family = family_of(parameters=[LEVEL], curve=lambda level: ((0.0,), (level,)))
    fit = linear_fit(family, [np.eye(2)], [np.zeros(2)], x=[2.0, 7.0], beside=(other,))
    law = law_of(FreeFit(family=family, fit=fit, beside=("tip_drag",), gap_after=1.0, final=True))
    assert (law.y, law.beside) == ((2.0,), ("tip_drag",))


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


def test_where_a_factor_is_held_at_its_limit_a_curve_tells_nothing():
    """Beyond where the log has been a smooth curve may go anywhere, up to the limit of a factor."""
    y = np.array([1.0, 1.2, 0.8, 5e4])
    band = np.array([[0.9, 1.1, 0.7, 5e4], [1.1, 1.3, 0.9, 5e4]])
    np.testing.assert_array_equal(_told(y, band), [True, True, True, False])
    open_end = np.array([[0.9, 1.1, 0.7, 2.0], [1.1, 1.3, 0.9, 5e5]])
    assert _told(y, open_end).all()
    # A factor of 1 before an event is known, and so is a curve that has no band at all.
    known = np.array([[1.0, 1.0, 0.4, 0.5], [1.0, 1.0, 0.6, 0.7]])
    assert _told(np.array([1.0, 1.0, 0.5, 0.6]), known).all()
    assert _told(y, np.stack([y, y])).all()


@pytest.mark.parametrize(("unit", "told"), [(VISCOUS, 1.6), ("N mm / mm", 2.0)])
def test_a_law_of_damping_is_told_with_the_damping_that_the_fit_has_beside_it(unit, told):
    """Laws of damping multiply that of the tissue, of which the fit knows how far it is off."""
    family = family_of(parameters=[LEVEL], curve=lambda level: ((0.0,), (level,)), unit=unit)
    fit = linear_fit(
        family, [np.eye(2)], [np.zeros(2)], x=[2.0, math.log(0.8)], beside=(LIBRARY["damping_error"],)
    )
    found = missing_of([FreeFit(family=family, fit=fit, gap_after=1.0, final=True)], 5.0)
    assert found.law.y == pytest.approx((told,))
