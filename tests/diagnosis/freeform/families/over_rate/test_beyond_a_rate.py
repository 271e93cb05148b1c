"""Viscous torque that grows otherwise beyond a rate."""

import numpy as np
import pytest
from diagnosis_fixtures import turns
from free_forms import DAMPING, covered, same_readings

from diagnosis.freeform.families.over_rate.beyond_a_rate import families
from diagnosis.freeform.families.over_rate.friction import rates_of
from diagnosis.replay.rig_parameters import NOMINAL
from models.tissue import RATE_POINTS

ANGLE = turns(6.0)
RANGES = covered(ANGLE, tip=ANGLE)
(FAMILY,) = families(RANGES)


def test_a_slope_of_one_is_the_nominal_rig():
    assert same_readings(ANGLE, FAMILY.effect.apply(NOMINAL, 1.0, 0.3), NOMINAL)
    assert not same_readings(ANGLE, FAMILY.effect.apply(NOMINAL, 0.3, 0.3), NOMINAL)


def test_below_the_rate_damping_is_nominal():
    fastest = RANGES.fastest_slip_rad_s
    assert same_readings(ANGLE, FAMILY.effect.apply(NOMINAL, 0.3, 1e3 * fastest), NOMINAL)


@pytest.mark.parametrize(("slope", "rate"), [(0.01, 0.3), (0.3, 1.2), (4.0, 0.5)])
def test_the_rig_has_the_law_at_every_rate(slope, rate):
    """Between places h apart the logarithm is straight, whose second derivative is slope (slope - 1)."""
    law = FAMILY.effect.apply(NOMINAL, slope, rate).free
    places = np.geomspace(*law.rate_range_rad_s, RATE_POINTS)
    at = np.geomspace(0.1 * rate, 8.0 * rate, 300)
    factor = np.exp(np.interp(np.log(at), np.log(places), np.log(law.rate_curve)))
    expected = np.where(at < rate, at, rate + slope * (at - rate)) / at
    h = np.log(places[1] / places[0])
    np.testing.assert_allclose(factor, expected, rtol=max(h**2 / 8 * slope * (slope - 1), 0.01))


def test_beyond_the_rate_the_torque_of_a_layer_that_slips_hardly_grows():
    rates, damping = FAMILY.curve(0.01, 0.3)
    assert rates[0] * damping[0] == pytest.approx(0.3 * DAMPING)
    assert rates[-1] * damping[-1] == pytest.approx(0.3 * DAMPING * (1 + 0.01 * 9), rel=1e-6)


def test_searches_start_at_rates_of_the_log_with_more_and_with_less():
    slopes, rates = (p.start for p in FAMILY.effect.parameters)
    low, high = rates_of(RANGES)
    assert min(slopes) < 1.0 < max(slopes)
    assert low < min(rates) < max(rates) < high
