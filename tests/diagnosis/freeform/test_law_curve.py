"""A free-form law as a curve with a band."""

import math
from dataclasses import replace

import numpy as np
import pytest
from free_forms import (
    CURVE,
    LEVEL,
    family_of,
    fitted_curve,
    linear_fit,
)

from diagnosis.effects import LIBRARY
from diagnosis.effects.effect import Place
from diagnosis.freeform.family import VISCOUS
from diagnosis.freeform.fits.free_fit import FreeFit
from diagnosis.freeform.law_curve import _determined, law_of
from diagnosis.freeform.missing.missing import missing_of


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


def test_where_a_factor_is_held_at_its_limit_a_curve_tells_nothing():
    """Beyond where the log has been a smooth curve may go anywhere, up to the limit of a factor."""
    y = np.array([1.0, 1.2, 0.8, 5e4])
    band = np.array([[0.9, 1.1, 0.7, 5e4], [1.1, 1.3, 0.9, 5e4]])
    np.testing.assert_array_equal(_determined(y, band), [True, True, True, False])
    open_end = np.array([[0.9, 1.1, 0.7, 2.0], [1.1, 1.3, 0.9, 5e5]])
    assert _determined(y, open_end).all()
    # A factor of 1 before an event is known, and so is a curve that has no band at all.
    known = np.array([[1.0, 1.0, 0.4, 0.5], [1.0, 1.0, 0.6, 0.7]])
    assert _determined(np.array([1.0, 1.0, 0.5, 0.6]), known).all()
    assert _determined(y, np.stack([y, y])).all()


@pytest.mark.parametrize(("unit", "told"), [(VISCOUS, 1.6), ("N mm / mm", 2.0)])
def test_a_law_of_damping_is_told_with_the_damping_that_the_fit_has_beside_it(unit, told):
    """Laws of damping multiply that of the tissue, of which the fit knows how far it is off."""
    family = family_of(parameters=[LEVEL], curve=lambda level: ((0.0,), (level,)), unit=unit)
    fit = linear_fit(
        family, [np.eye(2)], [np.zeros(2)], x=[2.0, math.log(0.8)], beside=(LIBRARY["damping_error"],)
    )
    found = missing_of([FreeFit(family=family, fit=fit, gap_after=1.0, final=True)], 5.0)
    assert found.law.y == pytest.approx((told,))
