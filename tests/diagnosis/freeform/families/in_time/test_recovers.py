"""Tissue that gives way once and recovers."""

import numpy as np
import pytest
from diagnosis_fixtures import turns
from free_forms import VOCABULARY, covered_by, same_readings

from diagnosis.freeform.families.in_time.recovers import families
from diagnosis.replay.rig_parameters import NOMINAL

ANGLE = turns(8.0)
TIME = 0.01 * np.arange(ANGLE.size)
REST = np.zeros(ANGLE.size)
CHANGE = 0.3 * np.sin(2.0 * TIME)


def of_a_change(at_s, number):
    """The law of three trials, one of whose tips is off by what less damping changes, and ever less."""
    rng = np.random.default_rng(3)
    faded = np.exp(-np.maximum(TIME - at_s, 0.0) / 3) * (at_s < TIME)
    fades = [(i == number) * faded for i in range(3)]
    tips = [6.0 * CHANGE * own + rng.normal(0, 0.25, TIME.size) for own in fades]
    seen = [(ANGLE, tip, (REST, REST)) for tip in tips]
    (family,) = families(covered_by(seen, softer=[(CHANGE, REST)] * 3))
    return family


@pytest.mark.parametrize(("at_s", "number"), [(3.0, 0), (5.0, 2)])
def test_it_starts_where_a_change_begins(at_s, number):
    family = of_a_change(at_s, number)
    assert family.effect.trial == f"trial_{number + 1:02d}.csv"
    assert family.effect.parameters[0].start[0] == pytest.approx(at_s, abs=0.5)
    assert family.says == "event"
    assert family.says in VOCABULARY


@pytest.mark.parametrize("factor", [0.4, 2.0])
def test_its_factor_falls_back_to_one_as_an_exponential(factor):
    """Through places between which a cubic is off by less than a hundredth of the change."""
    family, recovery_s = of_a_change(3.0, 0), 2.0
    (curve,) = family.effect.apply(NOMINAL, 3.0, factor, recovery_s).free.curves
    after = TIME[TIME > 3.2] - 3.1
    exact = 1.0 + (factor - 1.0) * np.exp(-after / recovery_s)
    np.testing.assert_allclose(curve.at(TIME[TIME > 3.2]), exact, atol=0.01 * abs(factor - 1.0))
    np.testing.assert_allclose(curve.at(TIME[TIME < 2.8]), 1.0)
    assert curve.trial == family.effect.trial
    x, y = family.curve(3.0, factor, recovery_s)
    np.testing.assert_allclose(np.interp(x, curve.places, curve.values), y)


def test_with_a_factor_of_one_nothing_changes():
    family = of_a_change(3.0, 0)
    assert same_readings(ANGLE, family.effect.apply(NOMINAL, 3.0, 1.0, 5.0), NOMINAL)
    assert not same_readings(ANGLE, family.effect.apply(NOMINAL, 3.0, 0.3, 5.0), NOMINAL)


def test_without_a_rig_of_less_damping_there_is_none():
    assert families(covered_by([(ANGLE, ANGLE, (REST, REST))])) == ()
