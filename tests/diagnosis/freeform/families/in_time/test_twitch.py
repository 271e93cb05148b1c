"""Tissue that turns once."""

import numpy as np
import pytest
from diagnosis_fixtures import RIG, prepared, trial, turns
from free_forms import VOCABULARY, covered

from diagnosis.freeform.families.in_time.twitch import families
from diagnosis.replay.replay import predict
from diagnosis.replay.rig_parameters import NOMINAL

ANGLE = turns(8.0)
TIME = 0.01 * np.arange(ANGLE.size)
REST = np.zeros(ANGLE.size)
STILL = prepared(trial(0.0 * ANGLE))


def of_a_step(at_s):
    """The law of a log whose tip steps."""
    noise = np.random.default_rng(2).normal(0, 0.25, ANGLE.size)
    (family,) = families(covered(ANGLE, tip=ANGLE + noise + 2.0 * (at_s < TIME), seen=(ANGLE, REST)))
    return family


def test_a_needle_whose_base_rests_follows_and_returns():
    """Viscous tissue that turns by 20 deg takes the tip along, and leaves it where the base is."""
    family = of_a_step(3.0)
    tip = predict(RIG, STILL, [family.effect.apply(NOMINAL, 3.0, 1.0, 20.0)])[0].tip_angle_deg
    assert np.abs(tip[TIME < 2.4]).max() < 1e-6
    assert 1.0 < tip[(TIME > 2.5) & (TIME < 3.6)].max() < 20.0
    assert abs(tip[-1]) < 0.02 * tip.max()


def test_it_starts_where_the_tip_steps_fast_or_slowly_to_either_side():
    family = of_a_step(5.0)
    when, lasting, step = family.effect.parameters
    assert when.start == (pytest.approx(5.0, abs=0.1),) * 4
    assert set(lasting.start) == {0.3, 3.0}
    assert {np.sign(own) for own in step.start} == {1.0, -1.0}
    assert family.says == "event"
    assert family.says in VOCABULARY
    assert family.effect.trial == "trial_01.csv"


def test_without_readings_of_the_tip_there_is_none():
    assert families(covered(ANGLE, torque=REST, seen=(ANGLE, REST))) == ()
