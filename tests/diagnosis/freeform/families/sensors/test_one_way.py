"""An encoder that counts differently each way."""

import numpy as np
import pytest
from diagnosis_fixtures import turns
from free_forms import VOCABULARY, covered, same_readings

from diagnosis.effects import LIBRARY
from diagnosis.freeform.families.sensors.one_way import families
from diagnosis.replay.rig_parameters import NOMINAL
from diagnosis.replay.sensing.sensors import driven
from sim.schedule import Schedule

ANGLE = turns(6.0)
(FAMILY,) = families(covered(ANGLE, tip=ANGLE))


def test_a_turn_and_back_ends_where_the_shares_differ():
    """360 deg in 4 s and back: 1 % more forwards, 2 % less backwards."""
    time_s = np.arange(0.0, 8.0, 0.01)
    same = np.full(time_s.size, 60.0)
    read = 90.0 * np.minimum(time_s, 8.0 - time_s)
    schedule = Schedule(time_s=time_s, drive=read, free_mm=same, inserted_mm=same, speed_mm_s=0.0 * same)
    turned = driven(FAMILY.effect.apply(NOMINAL, 0.01, -0.02), schedule).drive
    # Rates are taken over 0.02 s: a reversal at 90 deg/s blurs 1.8 deg, of which 2 % count.
    np.testing.assert_allclose(turned[400], 363.6, atol=0.1)
    np.testing.assert_allclose(turned[-1] - read[-1], 3.6 + 7.2, atol=0.1)


def test_the_same_share_each_way_is_a_gain():
    gained = LIBRARY["base_angle_scale"].apply(NOMINAL, 1.0 / 1.02)
    assert not same_readings(ANGLE, FAMILY.effect.apply(NOMINAL, 0.02, 0.0), NOMINAL)
    ahead = FAMILY.effect.apply(NOMINAL, 0.02, 0.02)
    time_s = np.arange(ANGLE.size) * 0.01
    same = np.full(ANGLE.size, 60.0)
    schedule = Schedule(
        time_s=time_s, drive=ANGLE, free_mm=same, inserted_mm=same, speed_mm_s=0.0 * same
    )
    there, gained = (driven(rig, schedule).drive for rig in (ahead, gained))
    np.testing.assert_allclose(there - there[0], gained - gained[0], atol=5e-3 * np.ptp(ANGLE))


def test_without_shares_it_is_the_nominal_rig_and_what_it_depends_on_has_a_word():
    assert same_readings(ANGLE, FAMILY.effect.apply(NOMINAL, 0.0, 0.0), NOMINAL)
    assert FAMILY.says == "direction"
    assert FAMILY.says in VOCABULARY
    assert all(p.low <= s <= p.high for p in FAMILY.effect.parameters for s in p.start)
    rates, ahead = (np.array(own) for own in FAMILY.curve(0.1, -0.2))
    np.testing.assert_allclose(ahead[rates > 0], np.degrees(0.1 * rates[rates > 0]))
    np.testing.assert_allclose(ahead[rates < 0], np.degrees(-0.2 * rates[rates < 0]))


def test_a_base_at_rest_has_none():
    assert families(covered(0.0 * ANGLE, tip=ANGLE)) == ()


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_it_is_straight_but_for_rest(sign):
    """Interpolation that kept the shape of three points alone would be flat at rest."""
    rig = FAMILY.effect.apply(NOMINAL, 0.1, -0.1)
    (curve,) = rig.free.curves
    rates = sign * np.array([0.1, 0.3, 0.7]) * curve.places[-1]
    np.testing.assert_allclose(-curve.at(rates), np.degrees(0.1 * np.abs(rates)), rtol=0.02)
