"""An encoder that loses counts where it turns fast: beyond a level the needle turns by more."""

import numpy as np
import pytest
from diagnosis_fixtures import turns
from free_forms import VOCABULARY, covered, same_readings

from diagnosis.effects.effect import Place
from diagnosis.freeform.families.sensors.losing_counts import families
from diagnosis.replay.rig_parameters import NOMINAL
from diagnosis.replay.sensing.sensors import driven, sensed
from sim.schedule import Schedule

ANGLE = turns(6.0)
SEEN = (ANGLE, 0.02 * ANGLE)
FAMILY, OF_EXCESS, OF_TIP = families(covered(ANGLE, tip=ANGLE, seen=SEEN))


def schedule(rate_deg_s):
    time_s = np.arange(0, 4, 0.01)
    same = np.full(time_s.size, 60.0)
    return Schedule(
        time_s=time_s, drive=rate_deg_s * time_s, free_mm=same, inserted_mm=same, speed_mm_s=0 * same
    )


@pytest.mark.parametrize("sign", [1, -1])
@pytest.mark.parametrize(("rate_deg_s", "ratio"), [(20.0, 1.0), (60.0, 1.25)])
def test_beyond_the_level_the_needle_turns_by_a_share_more(sign, rate_deg_s, ratio):
    """A level of 0.7 rad/s is one of 40 deg/s."""
    read = schedule(sign * rate_deg_s)
    turned = driven(FAMILY.effect.apply(NOMINAL, 0.7, 0.25), read).drive
    np.testing.assert_allclose(turned, ratio * read.drive, rtol=2e-3)


@pytest.mark.parametrize("sign", [1, -1])
@pytest.mark.parametrize(("rate_deg_s", "more_deg_s"), [(20.0, 0.0), (60.0, 0.25 * (60 - 40.1))])
def test_or_by_a_share_of_what_it_exceeds_the_level_by(sign, rate_deg_s, more_deg_s):
    read = schedule(sign * rate_deg_s)
    turned = driven(OF_EXCESS.effect.apply(NOMINAL, 0.7, 0.25), read).drive
    np.testing.assert_allclose(turned, (1.0 + more_deg_s / rate_deg_s) * read.drive, rtol=2e-3)


@pytest.mark.parametrize("family", [FAMILY, OF_EXCESS], ids=["of all", "of the excess"])
def test_without_a_share_it_is_the_nominal_rig(family):
    level = family.effect.parameters[0].start[0]
    assert same_readings(ANGLE, family.effect.apply(NOMINAL, level, 0.0), NOMINAL)
    assert not same_readings(ANGLE, family.effect.apply(NOMINAL, level, 0.3), NOMINAL)


def test_what_it_depends_on_has_a_word_and_a_base_at_rest_has_none():
    assert FAMILY.says == "rate"
    assert FAMILY.says in VOCABULARY
    assert all(p.low <= s <= p.high for p in FAMILY.effect.parameters for s in p.start)
    rates, ahead = FAMILY.curve(0.5, 0.2)
    assert ahead[-1] == pytest.approx(np.degrees(0.2 * rates[-1]))
    assert families(covered(0.0 * ANGLE, tip=ANGLE)) == ()


@pytest.mark.parametrize("sign", [1, -1])
@pytest.mark.parametrize(("rate_deg_s", "ratio"), [(20.0, 1.0), (60.0, 1.0 - 0.25 * (60 - 40.1) / 60)])
def test_beyond_its_level_the_counter_of_the_tip_loses_a_share_of_the_excess(sign, rate_deg_s, ratio):
    """A level of 0.7 rad/s is one of 40.1 deg/s."""
    turned = schedule(sign * rate_deg_s)
    rig = OF_TIP.effect.apply(NOMINAL, 0.7, -0.25)
    still = np.zeros(turned.time_s.size)
    read, torque = sensed(rig, turned, turned.drive, still)
    np.testing.assert_allclose(read, ratio * turned.drive, rtol=2e-3)
    np.testing.assert_array_equal(torque, still)


def test_it_is_a_law_of_the_tip_sensor():
    level = OF_TIP.effect.parameters[0].start[0]
    assert same_readings(ANGLE, OF_TIP.effect.apply(NOMINAL, level, 0.0), NOMINAL)
    assert not same_readings(ANGLE, OF_TIP.effect.apply(NOMINAL, level, -0.3), NOMINAL)
    assert (OF_TIP.says, OF_TIP.place) == ("rate", Place.SENSOR)
    rates, ahead = OF_TIP.curve(0.5, -0.2)
    assert ahead[-1] == pytest.approx(np.degrees(-0.2 * (rates[-1] - 0.5)))
