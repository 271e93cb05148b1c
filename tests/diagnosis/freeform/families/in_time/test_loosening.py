"""A chuck that works loose, against play that is there all the time."""

import numpy as np
import pytest
from diagnosis_fixtures import NOISE, RIG, joined, log_of, prepared, turns
from free_forms import covered_by

from diagnosis.effects.effect import Place
from diagnosis.freeform.families.in_time.loosening import families
from diagnosis.replay.replay import predict
from diagnosis.replay.rig_parameters import NOMINAL, RigParameters

ANGLE = turns(8.0)
TIME = 0.01 * np.arange(ANGLE.size)
REST = np.zeros(ANGLE.size)
CHANGE = 0.3 * np.sin(2.0 * TIME)
PLAY_DEG = 8.0


def families_at(at_s, number, *, stays=True, count=3):
    """Of trials whose residual is a multiple of what less damping changes, from a moment on."""
    rng = np.random.default_rng(3)
    there = [(stays and i > number) | ((i == number) & (at_s < TIME)) for i in range(count)]
    tips = [4.0 * CHANGE * own + rng.normal(0, 0.25, TIME.size) for own in there]
    covered = covered_by([(ANGLE, tip, (REST, REST)) for tip in tips], softer=[(CHANGE, REST)] * count)
    return {family.name.split(", ")[1]: family for family in families(covered)}


def residual(log_trial, rig):
    own = prepared(log_trial)
    found = predict(RIG, own, [rig.on_trial(own.name)])[0]
    left = [(own.readings[s] - found[s]) / NOISE[s] for s in ("tip_angle_deg", "base_torque_n_mm")]
    return [float(np.sqrt(np.mean(part**2))) for part in left]


def test_it_is_an_event_of_the_drive_once_or_for_good():
    found = families_at(5.0, 1)
    assert set(found) == {"once", "for good"}
    assert all((f.place, f.says) == (Place.DRIVE, "event") for f in found.values())
    assert found["for good"].effect.trial == ""
    x, y = found["for good"].curve(5.0, 0.2, PLAY_DEG)
    assert (0.5 * (x[1] + x[2]), y[0], y[-1]) == (5.0, 0.0, PLAY_DEG)
    assert set(families_at(3.0, 2)) == {"once"}  # nothing follows the last trial


def test_without_a_rig_of_less_damping_there_is_none():
    assert families(covered_by([(ANGLE, ANGLE, (REST, REST))])) == ()


def test_from_then_on_the_readings_are_those_of_play_and_before_of_none():
    loose = RigParameters(backlash_deg=PLAY_DEG)
    log = joined(*(log_of(rig, seed=i) for i, rig in enumerate((NOMINAL, NOMINAL, loose))))
    loosens = families_at(5.0, 1)["for good"].effect.apply(NOMINAL, 11.5, 0.1, PLAY_DEG)
    for trial, other in zip((log.trials[0], log.trials[2]), (loose, NOMINAL), strict=True):
        # 3.5 of 1 / sqrt(2 n) about 1, for n = 1200 readings.
        assert residual(trial, loosens) == pytest.approx([1.0, 1.0], abs=0.07)
        assert max(residual(trial, other)) > 2.0


def test_in_its_trial_the_needle_falls_back_at_that_moment():
    once = families_at(5.0, 1, stays=False)["once"].effect
    assert once.trial == "trial_02.csv"
    once = once.apply(NOMINAL, 5.0, 0.1, PLAY_DEG)
    own = prepared(joined(*(log_of(NOMINAL, seed=i) for i in range(2))).trials[1])
    loose, firm = predict(RIG, own, [once.on_trial(own.name), NOMINAL])
    moved = np.abs(loose["tip_angle_deg"] - firm["tip_angle_deg"])
    assert moved[own.time_s < 4.9].max() < 1e-9
    assert moved[own.time_s > 5.2].max() > 1.0
