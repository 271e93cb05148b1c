"""Smooth curves by coordinates that are a priori independent."""

import numpy as np
import pytest

from diagnosis.freeform.smooth_curve import (
    bent_curve,
    jumping_curve,
    periodic_curve,
    rough_curve,
    separate_values,
    smooth_curve,
    two_sided_curve,
    two_values,
)
from diagnosis.replay.curve import ActsOn
from diagnosis.replay.variables import Variable

COUNT = 8


def beside_lines(u, covariance):
    """What of a covariance is not on straight lines, by their orthonormal basis."""
    line = np.linalg.qr(np.stack([np.ones(u.size), u], axis=1))[0]
    off = np.eye(u.size) - line @ line.T
    return off @ covariance @ off


def test_the_first_two_coordinates_are_a_straight_line():
    curve = smooth_curve(2.0, 10.0, COUNT)
    assert (curve.size, curve.straight) == (COUNT, 2)
    values = curve.values([3.0, 0.5, *np.zeros(COUNT - 2)])
    np.testing.assert_allclose(values, np.linspace(2.5, 3.5, COUNT))
    np.testing.assert_allclose(curve.places, np.linspace(2.0, 10.0, COUNT))


def test_the_rest_has_the_covariance_of_a_gaussian_process_beside_lines():
    """exp(-(u - u')^2 / (2 0.4^2)), written out once more."""
    curve, u = smooth_curve(-5.0, 7.0, COUNT), np.linspace(-1, 1, COUNT)
    rest = curve.basis[:, curve.straight :]
    kernel = np.array([[np.exp(-((a - b) ** 2) / (2 * 0.16)) for b in u] for a in u])
    np.testing.assert_allclose(rest @ rest.T, beside_lines(u, kernel), atol=1e-12)
    np.testing.assert_allclose(curve.basis[:, :2].T @ rest, 0.0, atol=1e-12)


def test_the_rest_of_a_rough_curve_has_the_covariance_of_a_random_walk_that_returns():
    """exp(-|u - u'| / 0.4), and the first two coordinates are a line."""
    curve, u = rough_curve(-5.0, 7.0, COUNT), np.linspace(-1, 1, COUNT)
    rest = curve.basis[:, curve.straight :]
    kernel = np.array([[np.exp(-abs(a - b) / 0.4) for b in u] for a in u])
    np.testing.assert_allclose(rest @ rest.T, beside_lines(u, kernel), atol=1e-12)
    np.testing.assert_allclose(curve.basis[:, 1], u)


@pytest.mark.parametrize("curve", [smooth_curve(0.0, 1.0, COUNT), periodic_curve(360.0)])
def test_any_values_are_some_coordinates(curve):
    wanted = np.random.default_rng(2).normal(size=curve.places.size)
    found = np.linalg.solve(curve.basis, wanted)
    np.testing.assert_allclose(curve.values(found), wanted, atol=1e-9)


def test_what_fades_has_its_places_where_it_is_fast():
    even, fading = smooth_curve(1.0, 5.0, COUNT), smooth_curve(1.0, 5.0, COUNT, fading=True)
    assert (fading.places[0], fading.places[-1]) == (1.0, 5.0)
    np.testing.assert_allclose(np.sqrt((fading.places - 1.0) / 4.0), (even.places - 1.0) / 4.0)


def test_a_periodic_curve_prefers_no_phase():
    """Covariances of its rest depend on how far places are from each other around the period alone."""
    curve = periodic_curve(90.0, 5)
    assert (curve.straight, curve.period) == (1, 90.0)
    assert curve.places[-1] == pytest.approx(90.0 * 4 / 5)  # the last place is not the first again
    rest = curve.basis[:, 1:] @ curve.basis[:, 1:].T
    for i in range(5):
        np.testing.assert_allclose(np.roll(rest[i], -i), rest[0], atol=1e-12)
    np.testing.assert_allclose(rest.sum(axis=0), 0.0, atol=1e-12)


def test_two_values_are_a_mean_and_a_difference():
    assert two_values().values([3.0, 0.5]) == (2.5, 3.5)


def test_separate_values_are_their_coordinates():
    curve = separate_values(np.array([0.1, 1.0, 3.0]))
    assert curve.straight == 0
    assert curve.values([4.0, 5.0, 6.0]) == (4.0, 5.0, 6.0)


def test_a_bent_curve_has_a_slope_on_each_side_of_zero():
    """Both slopes and the value at zero are its straight part: a line and |x| make any of them."""
    curve = bent_curve(-2.0, 10.0, 12)
    assert curve.straight == 3
    assert 0.0 in curve.places
    assert np.all(np.diff(curve.places) > 0)
    assert (curve.places[0], curve.places[-1]) == (-2.0, 10.0)
    wanted = np.where(curve.places < 0, 0.3 * curve.places, 0.5 * curve.places) + 1.0
    found = np.linalg.solve(curve.basis, wanted)
    np.testing.assert_allclose(found[3:], 0.0, atol=1e-8)
    np.testing.assert_allclose(found[:3], [1.0, 4.0, 1.0], atol=1e-8)


def test_of_one_sign_nothing_is_bent():
    one, smooth = bent_curve(1.0, 5.0), smooth_curve(1.0, 5.0)
    np.testing.assert_array_equal(one.basis, smooth.basis)
    np.testing.assert_array_equal(one.places, smooth.places)


def test_coordinates_are_those_of_the_curve_that_comes_nearest_to_values():
    curve = smooth_curve(0.0, 2.0, 7)
    given = np.random.default_rng(5).normal(size=curve.size)
    np.testing.assert_allclose(curve.coordinates(curve.values(given)), given, atol=1e-9)


def test_a_curve_that_jumps_has_a_value_at_rest_and_a_line_on_each_side():
    curve = jumping_curve(-10.0, 5.0)
    assert curve.straight == 5
    values = np.array(curve.values([7.0, 1.0, 2.0, 3.0, 4.0, *np.zeros(curve.size - 5)]))
    u = curve.places / 10.0
    expected = np.where(u < 0, 1.0 + 3.0 * u, np.where(u > 0, 2.0 + 4.0 * u, 7.0))
    np.testing.assert_allclose(values, expected)
    assert (curve.places[0], curve.places[-1], 0.0 in curve.places) == (-10.0, 5.0, True)


def test_the_smooth_part_of_a_curve_that_jumps_knows_nothing_of_the_other_side():
    curve = jumping_curve(-10.0, 10.0)
    rest = curve.basis[:, curve.straight :]
    covariance = rest @ rest.T
    before, after = curve.places < 0, curve.places > 0
    np.testing.assert_allclose(covariance[np.ix_(before, after)], 0.0, atol=1e-12)
    assert covariance[np.ix_(after, after)].max() > 0.01


def test_a_range_of_one_sign_has_one_side():
    curve = jumping_curve(0.0, 5.0)
    assert (curve.straight, curve.places[0]) == (3, 0.0)
    assert jumping_curve(-5.0, 0.0).places[-1] == 0.0


def test_the_signs_of_a_two_sided_curve_differ_by_a_jump_and_a_slope_alone():
    curve = two_sided_curve(3.0, 7)
    assert (curve.places.size, curve.straight) == (14, 4)
    np.testing.assert_allclose(curve.places[7:], 3.0 * np.linspace(0.0, 1.0, 7) ** 2, atol=1e-5)
    np.testing.assert_allclose(curve.places, -curve.places[::-1])
    mirrored = curve.basis[::-1]
    signs = np.array([1.0, 1.0, -1.0, -1.0, *np.ones(curve.size - 4)])
    np.testing.assert_allclose(mirrored, curve.basis * signs, atol=1e-7)
    # Next to zero it is the constant on both sides, and the jump.
    values = curve.values([0.5, 0.0, 0.2, 0.0, *np.zeros(curve.size - 4)])
    assert (values[6], values[7]) == (pytest.approx(0.3), pytest.approx(0.7))


ADDED = {
    ActsOn.TIP_TORQUE,
    ActsOn.ORIENTATION,
    ActsOn.TISSUE_ANGLE,
    ActsOn.TISSUE_SLIP,
    ActsOn.DRIVE_ANGLE,
    ActsOn.DRIVE_SLIP,
    ActsOn.INSERTED_LENGTH,
    ActsOn.FREE_LENGTH,
    ActsOn.DRIVE_TORQUE,
    ActsOn.TIP_READING,
    ActsOn.TIP_COUNTS,
    ActsOn.TORQUE_READING,
}


@pytest.mark.parametrize("acts_on", ActsOn)
def test_in_a_law_a_curve_is_of_factors_where_it_multiplies_and_else_of_values(acts_on):
    curve, c = periodic_curve(360.0), (0.4, -0.2, 0.1)
    c = (*c, *[0.0] * (curve.size - len(c)))
    own = curve.acting_on(acts_on, Variable.BASE_ANGLE, c)
    multiplies = acts_on not in ADDED
    expected = np.exp(curve.values(c)) if multiplies else curve.values(c)
    np.testing.assert_allclose(own.values, expected)
    assert own.places == tuple(curve.places)
    assert (own.acts_on, own.variable, own.period) == (acts_on, Variable.BASE_ANGLE, 360.0)


def test_no_factor_is_0_or_infinite():
    curve = smooth_curve(0.0, 1.0)
    for far in (-1e4, 1e4):
        factors = np.array(curve.factors([far] + [0.0] * (curve.size - 1)))
        assert np.isfinite(factors).all()
        assert (factors > 0).all()


@pytest.mark.parametrize("made", [smooth_curve, bent_curve])
def test_a_curve_that_is_zero_at_zero_has_no_constant_and_keeps_its_slopes(made):
    curve = made(-2.0, 3.0, 12)
    pinned = curve.zero_at_zero()
    assert (pinned.size, pinned.straight) == (curve.size - 1, curve.straight - 1)
    drawn = pinned.values(np.random.default_rng(1).normal(size=pinned.size))
    assert np.interp(0.0, pinned.places, drawn) == pytest.approx(0.0, abs=1e-12)
    np.testing.assert_allclose(
        np.diff(pinned.values([1.0] * pinned.size)), np.diff(curve.values([0.0] + [1.0] * pinned.size))
    )


def test_a_curve_that_does_not_reach_zero_stays():
    curve = smooth_curve(1.0, 3.0)
    assert curve.zero_at_zero() is curve


FINER = [
    smooth_curve(2.0, 10.0, COUNT),
    bent_curve(-3.0, 5.0, COUNT, close=True),
    periodic_curve(360.0),
]


@pytest.mark.parametrize("curve", FINER)
def test_a_finer_curve_without_detail_goes_through_the_places_of_the_curve_as_it_is(curve):
    finer, own = curve.finer, np.random.default_rng(3).normal(size=curve.size)
    values = np.array(finer.values([*own, *np.zeros(finer.detail)]))
    np.testing.assert_allclose(
        values[np.isin(finer.places, curve.places)], curve.values(own), atol=1e-12
    )
    assert (finer.straight, finer.period) == (curve.straight, curve.period)


@pytest.mark.parametrize("curve", FINER)
def test_halfway_the_straight_part_of_a_finer_curve_is_straight(curve):
    finer, straight = curve.finer, np.zeros(curve.size)
    straight[: curve.straight] = 0.5, *np.ones(curve.straight - 1)
    line = np.interp(finer.places, curve.places, curve.values(straight), period=curve.period or None)
    np.testing.assert_allclose(finer.values([*straight, *np.zeros(finer.detail)]), line, atol=1e-12)


def test_halfway_a_sine_stays_a_sine():
    curve = periodic_curve(360.0)
    own = curve.coordinates(np.sin(np.radians(curve.places)))
    values = curve.finer.values([*own, *np.zeros(curve.finer.detail)])
    error = 5.0 / 384.0 * np.radians(30.0) ** 4  # of a cubic spline, times a fourth derivative of 1
    np.testing.assert_allclose(values, np.sin(np.radians(curve.finer.places)), atol=error)


@pytest.mark.parametrize("curve", FINER)
def test_each_detail_of_a_finer_curve_is_halfway_between_two_places(curve):
    finer = curve.finer
    detail = finer.basis[:, -finer.detail :]
    np.testing.assert_array_equal(detail.T @ detail, np.eye(finer.detail))
    at = finer.places[detail.argmax(axis=0)]
    ends = [*curve.places, curve.period] if curve.period else curve.places
    np.testing.assert_allclose(at, 0.5 * (np.array(ends)[1:] + np.array(ends)[:-1]))
    assert set(curve.places) <= set(finer.places)


def test_a_finer_curve_that_is_zero_at_zero_keeps_its_detail():
    finer = bent_curve(-3.0, 5.0, COUNT).finer
    held = finer.zero_at_zero()
    assert held.detail == finer.detail == COUNT - 1
    own = np.random.default_rng(4).normal(size=held.size)
    assert np.interp(0.0, held.places, held.values(own)) == pytest.approx(0.0, abs=1e-12)
