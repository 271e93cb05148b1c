"""Tissue that gives way once."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import RIG, prepared, trial, turns
from free_forms import covered_by

from diagnosis.effects.effect import Place
from diagnosis.freeform.families.in_time.changes import changes_of, families, largest_change
from diagnosis.freeform.families.in_time.events import trials_after
from diagnosis.replay.replay import predict
from diagnosis.replay.rig_parameters import NOMINAL, RigParameters

ANGLE = turns(8.0)
TIME = 0.01 * np.arange(ANGLE.size)
REST = np.zeros(ANGLE.size)
CHANGE = 0.3 * np.sin(2.0 * TIME)
"""What less damping changes, deg; the noise is NOISE."""


def log_with_a_change(at_s, number, size=4.0, count=3):
    """Ranges of trials whose residual is a multiple of that change from a moment of one of them on."""
    rng = np.random.default_rng(3)
    there = [(i > number) | ((i == number) & (at_s < TIME)) for i in range(count)]
    tips = [size * CHANGE * own + rng.normal(0, 0.25, TIME.size) for own in there]
    seen = [(ANGLE, tip, (REST, REST)) for tip in tips]
    return covered_by(seen, softer=[(CHANGE, REST)] * count)


@pytest.mark.parametrize(("at_s", "number"), [(3.0, 0), (5.5, 1), (2.0, 2), (0.0, 1)])
def test_the_moment_is_found_in_noise(at_s, number):
    found = largest_change(log_with_a_change(at_s, number))
    assert found.trial == f"trial_{number + 1:02d}.csv"
    assert found.time_s == pytest.approx(at_s, abs=0.3)  # what less damping changes swings within 3 s


@pytest.mark.parametrize(("at_s", "number"), [(3.0, 0), (5.5, 1), (2.0, 2)])
def test_a_change_that_ends_with_its_trial_is_found_there(at_s, number):
    rng = np.random.default_rng(3)
    there = [(i == number) & (at_s < TIME) for i in range(3)]
    tips = [4.0 * CHANGE * own + rng.normal(0, 0.25, TIME.size) for own in there]
    ranges = covered_by([(ANGLE, tip, (REST, REST)) for tip in tips], softer=[(CHANGE, REST)] * 3)
    found = largest_change(ranges, stays=False)
    assert found.trial == f"trial_{number + 1:02d}.csv"
    assert found.time_s == pytest.approx(at_s, abs=0.3)
    once = next(f for f in families(ranges) if f.name == "tissue that gives way, once")
    assert once.effect.trial == found.trial
    (only,) = once.effect.apply(NOMINAL, at_s, 0.1, 0.5).free.curves
    assert only.trial == found.trial


@pytest.mark.parametrize(("early", "late", "told"), [(8.0, -5.0, 1), (3.0, -8.0, 3)])
def test_where_nothing_follows_what_stays_the_larger_change_of_one_trial_counts(early, late, told):
    """One in the first trial that is over, and one in the last, the other way: that stays."""
    rng = np.random.default_rng(3)
    sizes = (early * (TIME > 3.0), 0.0 * TIME, late * (TIME > 3.0))
    tips = [size * CHANGE + rng.normal(0, 0.25, TIME.size) for size in sizes]
    ranges = covered_by([(ANGLE, tip, (REST, REST)) for tip in tips], softer=[(CHANGE, REST)] * 3)
    assert trials_after(ranges, largest_change(ranges)) == ()
    ((moment, after),) = changes_of(ranges)
    assert (moment.trial, after) == (f"trial_{told:02d}.csv", ())


def test_a_trial_without_readings_tells_nothing():
    whole = log_with_a_change(3.0, 0)
    unread = replace(whole.problem.log.trials[1], readings={})
    trials = (whole.problem.log.trials[0], unread, whole.problem.log.trials[2])
    log = replace(whole.problem.log, trials=trials)
    without = replace(whole, problem=replace(whole.problem, log=log))
    assert largest_change(without) == largest_change(whole)
    assert len(families(without)) == len(families(whole))


def test_without_a_rig_of_less_damping_there_is_none():
    assert families(covered_by([(ANGLE, ANGLE, (REST, REST))])) == ()


def test_it_is_of_the_tissue_and_stays():
    family, *_ = families(log_with_a_change(5.0, 0))
    assert (family.place, family.says, family.effect.trial) == (Place.TISSUE, "event", "")
    changes, *stay = family.effect.apply(NOMINAL, 5.0, 0.1, 0.5).free.curves
    np.testing.assert_allclose(changes.at(np.array([0.0, 4.95, 5.05, 8.0])), [1.0, 1.0, 0.5, 0.5])
    assert [own.trial for own in stay] == ["trial_02.csv", "trial_03.csv"]
    x, y = family.curve(5.0, 0.1, 0.5)
    assert (0.5 * (x[1] + x[2]), y[0], y[-1]) == (5.0, 1.0, 0.5)


def test_trials_after_it_are_those_of_a_rig_with_less_damping_and_those_before_of_the_nominal_one():
    family, *_ = families(log_with_a_change(5.0, 1))
    gives_way = family.effect.apply(NOMINAL, 5.0, 0.1, 0.5)
    for name, rig in (("trial_01.csv", NOMINAL), ("trial_03.csv", RigParameters(damping_scale=0.5))):
        own = prepared(trial(ANGLE, name=name))
        found, expected = predict(RIG, own, [gives_way, rig])
        np.testing.assert_allclose(found.tip_angle_deg, expected.tip_angle_deg, atol=1e-6)
