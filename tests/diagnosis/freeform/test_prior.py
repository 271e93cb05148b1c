"""How strong the prior of a curve is, against closed forms of Gaussian problems."""

import math
from dataclasses import replace

import numpy as np
import pytest
from free_forms import LEVEL, family_of, linear_fit, priors

from diagnosis.freeform.family import coordinates
from diagnosis.freeform.prior import LEAST, MOST, free_covariance, well_determined, with_estimated_prior

COUNT = 60


def readings_of(tau, slope, rng):
    """Readings slope * c + noise of 1, of coordinates c of standard deviation tau."""
    return slope * rng.normal(0, tau, COUNT) + rng.normal(size=COUNT)


def test_the_covariance_is_that_of_ridge_regression():
    rng = np.random.default_rng(1)
    family = family_of(parameters=coordinates(1, 3))
    family = family.with_prior({"straight": 2.0, "rest": 0.5})
    slopes = [rng.normal(size=(30, 4)) for _ in range(3)]
    fit = linear_fit(family, slopes, [np.zeros(30)] * 3)
    for without in (None, 1):
        seen = np.vstack([j for i, j in enumerate(slopes) if i != without])
        exact = np.linalg.inv(seen.T @ seen + np.diag(priors(family) ** -2.0))
        np.testing.assert_allclose(free_covariance(fit, without=without), exact, rtol=1e-6)


def test_what_is_left_above_the_noise_counts_as_noise():
    slopes = [np.random.default_rng(2).normal(size=(400, 2))]
    family = family_of(parameters=[replace(LEVEL, name=name) for name in ("a", "b")])
    quiet, loud = (linear_fit(family, slopes, [size * np.ones(400)], x=[0, 0]) for size in (0.5, 3.0))
    exact = np.linalg.inv(slopes[0].T @ slopes[0])
    np.testing.assert_allclose(free_covariance(quiet), exact, rtol=1e-6)
    np.testing.assert_allclose(free_covariance(loud), 9.0 * exact, rtol=1e-6)


@pytest.mark.parametrize("slope", [0.1, 1.0, 10.0])
def test_data_determine_the_share_of_a_coordinate_that_they_narrow_it_by(slope):
    """Prior 1, data 1 / slope: s^2 / (s^2 + 1) of each; all of what has no prior."""
    family = family_of(parameters=[LEVEL, *coordinates(1, 2)])
    fit = linear_fit(family, [slope * np.eye(4)], [np.zeros(4)])
    exact = 1.0 + 3 * slope**2 / (slope**2 + 1)
    assert well_determined(family, fit) == pytest.approx(exact, rel=1e-3)


def test_what_is_beside_a_family_is_not_counted_as_its_own():
    other = replace(family_of().effect, name="other", parameters=(LEVEL,))
    family = family_of(parameters=(LEVEL,))
    fit = linear_fit(family, [np.eye(2)], [np.zeros(2)], x=[0, 0], beside=(other,))
    assert well_determined(family, fit) == pytest.approx(1.0)


@pytest.mark.parametrize(("tau", "slope"), [(3.0, 10.0), (0.5, 3.0)])
def test_repeated_it_comes_to_where_the_evidence_is_greatest(tau, slope):
    """Readings have the variance (slope tau)^2 + 1: evidence says tau^2 = (mean y^2 - 1) / slope^2."""
    y = readings_of(tau, slope, np.random.default_rng(4))
    family = family_of(parameters=coordinates(0, COUNT))
    for _ in range(60):
        fit = linear_fit(family, [slope * np.eye(COUNT)], [y])
        family = with_estimated_prior(family, fit)
    found = priors(family)[0]
    assert found == pytest.approx(math.sqrt(np.mean(y**2) - 1) / slope, rel=1e-3)
    # A variance of n readings is known to sqrt(2 / n): tau to half that, times (1 + 1 / (slope tau)^2).
    known = (1 + 1 / (slope * tau) ** 2) / math.sqrt(2 * COUNT)
    assert found == pytest.approx(tau, rel=3.5 * known)


def test_straight_part_and_rest_have_strengths_of_their_own():
    rng = np.random.default_rng(5)
    y = np.concatenate([readings_of(5.0, 20.0, rng), readings_of(0.3, 20.0, rng)])
    family = family_of(parameters=coordinates(COUNT, COUNT))
    found = priors(with_estimated_prior(family, linear_fit(family, [20.0 * np.eye(2 * COUNT)], [y])))
    assert found[0] == pytest.approx(5.0, rel=3.5 / math.sqrt(2 * COUNT))
    assert found[-1] == pytest.approx(0.3, rel=3.5 / math.sqrt(2 * COUNT))


def test_a_strength_stays_within_its_limits():
    family = family_of(parameters=[LEVEL, *coordinates(0, 3)])
    for reading, strength in ((0.0, LEAST), (1e6, MOST)):
        fit = linear_fit(family, [np.eye(4)], [np.zeros(4)], x=[0.0, *[reading] * 3])
        assert priors(with_estimated_prior(family, fit))[1:] == pytest.approx(strength)


def test_a_family_without_a_curve_keeps_its_parameters():
    family = family_of(parameters=[LEVEL])
    fit = linear_fit(family, [np.eye(1)], [np.ones(1)])
    assert with_estimated_prior(family, fit).effect.parameters == (LEVEL,)
