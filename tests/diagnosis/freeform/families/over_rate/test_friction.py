"""Friction over the rate: where it becomes an effect of the library, it is that."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import turns
from free_forms import DAMPING, covered, same_readings

from diagnosis.effects import LIBRARY
from diagnosis.freeform.families.over_rate.friction import PLACES, at_one_rate, families, rates_of
from diagnosis.replay.rig_parameters import NOMINAL

ANGLE = turns(6.0)
RANGES = covered(ANGLE, tip=ANGLE)
(FAMILY,) = families(RANGES)
LEVEL, SCALE = 0.001, 1.2
DRY = LIBRARY["coulomb_friction"].apply(NOMINAL, LEVEL)
THICK = LIBRARY["damping_error"].apply(NOMINAL, SCALE)


def rig_of(level, straight=0.0):
    return FAMILY.effect.apply(NOMINAL, level, straight, *[0.0] * (PLACES - 1))


def test_friction_is_dry_and_viscous_where_its_curve_is_level():
    assert same_readings(ANGLE, rig_of(LEVEL), DRY)
    assert same_readings(ANGLE, rig_of(1e-12, straight=np.log(SCALE)), THICK)


def test_the_curve_is_the_torque_of_a_mm_of_shaft():
    rates, torque = FAMILY.curve(LEVEL, *[0.0] * PLACES)
    np.testing.assert_allclose(torque, LEVEL + DAMPING * np.asarray(rates))
    np.testing.assert_allclose((rates[0], rates[-1]), rates_of(RANGES))


def test_a_detailed_curve_is_the_same_friction_where_its_detail_is_none():
    """A power law: its logarithm is straight."""
    (finer,) = families(replace(RANGES, detail=1))
    own = (0.2, -0.5, *[0.0] * (PLACES - 2))
    detail = len(finer.effect.parameters) - len(FAMILY.effect.parameters)
    assert detail == PLACES - 1
    rig = finer.effect.apply(NOMINAL, LEVEL, *own, *[0.0] * detail)
    assert same_readings(ANGLE, rig, FAMILY.effect.apply(NOMINAL, LEVEL, *own))
    rig = finer.effect.apply(NOMINAL, LEVEL, *own, *[0.3] * detail)
    assert not same_readings(ANGLE, rig, FAMILY.effect.apply(NOMINAL, LEVEL, *own))


def test_rates_reach_beyond_the_fastest_slip_of_the_nominal_shaft():
    low, high = rates_of(RANGES)
    assert low < 0.01 * RANGES.fastest_slip_rad_s
    assert high > RANGES.fastest_slip_rad_s


def test_a_law_at_one_rate_starts_with_each_size_at_each_share_of_the_rates():
    sizes, rate = at_one_rate(RANGES, (0.5, 2.0), (0.0, 1.0))
    assert sizes == (0.5, 0.5, 2.0, 2.0)
    assert rate.start == pytest.approx((rate.low, rate.high) * 2)
    assert (rate.low, rate.high) == rates_of(RANGES)
