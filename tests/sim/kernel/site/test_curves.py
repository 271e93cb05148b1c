"""Curves of a row, in the interpreter: between their places, beyond them, and what a site remembers."""

import math

import pytest
from scipy.integrate import quad


@pytest.fixture
def curves(interpreted):
    return interpreted.curves


@pytest.fixture
def row(interpreted):
    places = interpreted.memory_map
    values = [0.0] * places.COLUMNS
    values[places.L_PLATEAU] = 1e-5
    values[places.L_RATE_LOW], values[places.L_RATE_STEP] = math.log(0.01), 1.0
    for i in range(places.CURVE_POINTS):
        values[places.L_CURVE_0 + i] = 0.1 * i
    values[places.L_CONTACT_SCALE], values[places.L_CONTACT_STEP] = 2.0, 0.5
    for i in range(places.CONTACT_POINTS):
        values[places.L_CONTACT_0 + i] = -0.2 * i
    values[places.L_RENEWAL], values[places.L_FADING] = 0.5, 4.0
    return values


@pytest.mark.parametrize(
    ("log_rate", "log_factor"), [(-2.0, 0.0), (0.0, 0.0), (2.5, 0.25), (22.0, 2.2), (25.0, 2.2)]
)
def test_a_curve_over_the_rate_is_straight_between_places_and_level_beyond(
    curves, row, log_rate, log_factor
):
    for sign in (1, -1):
        factor, rise = curves.rate_factor(sign * 0.01 * math.exp(log_rate), row)
        assert math.log(factor) == pytest.approx(log_factor)
        assert rise == pytest.approx(0.1 if 0 < log_rate < 22 else 0.0)


@pytest.mark.parametrize(("u", "log_factor"), [(0.0, 0.0), (0.75, -0.3), (4.0, -1.6), (7.0, -1.6)])
def test_a_curve_over_the_past_is_straight_in_its_logarithm(curves, row, u, log_factor):
    at, step = 2.0 * math.expm1(u), 1e-6
    factor, slope = curves.contact_factor(at, row)
    assert math.log(factor) == pytest.approx(log_factor)
    ahead = curves.contact_factor(at + step, row)[0]
    assert slope == pytest.approx((ahead - factor) / step, abs=1e-6)


@pytest.mark.parametrize("twist", [0.0, 0.3, 5.0, 300.0])
def test_the_mean_factor_is_the_integral_over_the_twist(curves, row, twist):
    """2 / twist^2 times the integral of factor x dx, by quadrature."""
    exact = quad(lambda x: curves.contact_factor(x, row)[0] * x, 0, twist, limit=400)[0]
    wanted = 2 * exact / twist**2 if twist else 1.0
    assert curves.mean_factor(twist, row) == pytest.approx(wanted, rel=1e-6)


def test_slip_adds_up_whichever_way(curves, row, interpreted):
    row[interpreted.memory_map.L_CONTACT] = interpreted.memory_map.SLIP_SO_FAR
    assert curves.past_after(1.0, 3.0, 0.1, row) == pytest.approx(1.3)
    assert curves.past_after(1.0, -3.0, 0.1, row) == pytest.approx(1.3)


def test_age_grows_at_rest_and_tends_to_renewal_over_rate(curves, row, interpreted):
    row[interpreted.memory_map.L_CONTACT] = interpreted.memory_map.AGE
    assert curves.past_after(2.0, 0.0, 0.1, row) == pytest.approx(2.1)
    age = 2.0
    for _ in range(2000):
        age = curves.past_after(age, -0.25, 0.1, row)
    assert age == pytest.approx(0.5 / 0.25)


def test_what_slip_breaks_heals_at_rest_and_tends_to_where_both_are_even(curves, row, interpreted):
    """At rest by a factor exp(-t / fading); at a rate s to x / (1 + x), x = s fading / renewal."""
    row[interpreted.memory_map.L_CONTACT] = interpreted.memory_map.BROKEN
    assert curves.past_after(0.6, 0.0, 0.1, row) == pytest.approx(0.6 / (1.0 + 0.1 / 4.0))
    broken = 0.0
    for _ in range(2000):
        broken = curves.past_after(broken, -0.25, 0.1, row)
    assert broken == pytest.approx(2.0 / 3.0)


def test_turning_back_forgets_the_way_before_within_a_renewal_and_counts_anew(curves, row, interpreted):
    """Back by x, z > 0 falls as (z + d) exp(-x / d) - d, to 0 at x = d ln(1 + z / d); then by x."""
    row[interpreted.memory_map.L_CONTACT] = interpreted.memory_map.TURNED
    renewal = row[interpreted.memory_map.L_RENEWAL]
    turned = 0.0
    for _ in range(200):
        turned = curves.past_after(turned, 0.25, 0.1, row)
    assert turned == pytest.approx(200 * 0.025)
    zero, steps, back = renewal * math.log1p(turned / renewal), 200_000, 10.0
    for _ in range(steps):
        turned = curves.past_after(turned, -back / steps, 1.0, row)
    assert turned == pytest.approx(zero - back, rel=1e-3)
