"""Damping that peaks at a rate."""

import numpy as np
import pytest
from diagnosis_fixtures import turns
from free_forms import DAMPING, covered, same_readings

from diagnosis.effects import LIBRARY
from diagnosis.freeform.families.over_rate.friction import rates_of
from diagnosis.freeform.families.over_rate.peak import families
from diagnosis.replay.rig_parameters import NOMINAL
from models.tissue import RATE_POINTS

ANGLE = turns(6.0)
RANGES = covered(ANGLE, tip=ANGLE)
(FAMILY,) = families(RANGES)


def test_a_peak_of_no_height_is_the_nominal_rig():
    assert same_readings(ANGLE, FAMILY.effect.apply(NOMINAL, 0.0, 0.3, 0.5), NOMINAL)
    assert not same_readings(ANGLE, FAMILY.effect.apply(NOMINAL, 0.3, 0.3, 0.5), NOMINAL)


def test_at_rates_far_below_a_peak_damping_is_nominal_and_far_above_too():
    """The ends of the curve are off by 0.2 % of the height, and so is at most what is read."""
    fastest = RANGES.fastest_slip_rad_s
    for rate in (1e3 * fastest, 1e-9 * fastest):
        assert same_readings(ANGLE, FAMILY.effect.apply(NOMINAL, 0.5, rate, 0.5), NOMINAL, within=1e-3)


@pytest.mark.parametrize(("height", "rate", "width"), [(0.4, 0.3, 0.5), (-0.6, 1.2, 1.0)])
def test_the_rig_has_the_law_at_every_rate(height, rate, width):
    """Straight between places 0.45 widths apart: off by at most height 0.45^2 / 8 * 2 = 5 %."""
    law = FAMILY.effect.apply(NOMINAL, height, rate, width).free
    low, high = law.rate_range_rad_s
    at = np.geomspace(low, high, 300)
    places = np.geomspace(low, high, RATE_POINTS)
    factor = np.exp(np.interp(np.log(at), np.log(places), np.log(law.rate_curve)))
    expected = 1.0 + height * np.exp(-((np.log(at / rate) / width) ** 2))
    np.testing.assert_allclose(factor, expected, atol=0.06 * abs(height) / (1.0 + min(height, 0.0)))
    assert abs(law.rate_curve[0] - 1.0) < 0.002 * abs(height)


def test_the_curve_is_told_in_the_units_of_the_needle():
    rates, damping = FAMILY.curve(0.5, 0.3, 0.4)
    assert np.max(damping) == pytest.approx(1.5 * DAMPING, rel=0.02)
    assert np.sqrt(rates[0] * rates[-1]) == pytest.approx(0.3)


def test_searches_start_at_rates_of_the_log_with_more_and_with_less():
    heights, rates, _ = (p.start for p in FAMILY.effect.parameters)
    low, high = rates_of(RANGES)
    assert min(heights) < 0.0 < max(heights)
    assert low < min(rates) < max(rates) < high


def test_a_wide_peak_in_the_middle_of_all_rates_is_nearly_damping_of_another_size():
    """To where its factor has fallen: within exp(-(ln 3 / 2)^2) = 0.74 of the height over a decade."""
    low = 0.3 * RANGES.fastest_slip_rad_s
    thick = LIBRARY["damping_error"].apply(NOMINAL, 1.2)
    peak = FAMILY.effect.apply(NOMINAL, 0.2, low, 2.0)
    assert same_readings(ANGLE, peak, thick, within=0.1)
