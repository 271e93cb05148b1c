"""Something that happened once."""

import numpy as np
import pytest
from diagnosis_fixtures import turns
from free_forms import covered, covered_by

from diagnosis.effects.effect import Place
from diagnosis.freeform.families.in_time.events import around, change_between, events, families
from diagnosis.replay.rig_parameters import NOMINAL

ANGLE = turns(8.0)
TIME = 0.01 * np.arange(ANGLE.size)
NOISE = np.random.default_rng(9).normal(0, 0.25, ANGLE.size)
AT_REST = (ANGLE, np.zeros(ANGLE.size))


def stepping(at_s, size):
    """Ranges of a log whose tip sensor jumps, by a nominal rig that reads the base."""
    return covered(ANGLE, tip=ANGLE + NOISE + size * (at_s < TIME), seen=AT_REST)


def two_trials(at_s, size, number=0):
    """Ranges of two trials, of which that of a number has the step."""
    tips = [ANGLE + NOISE + size * (i == number) * (at_s < TIME) for i in range(2)]
    return covered_by([(ANGLE, tip, AT_REST) for tip in tips])


@pytest.mark.parametrize(("at_s", "size"), [(2.0, 1.0), (5.5, -0.8), (7.0, 3.0)])
def test_a_step_in_noise_is_found_where_it_is(at_s, size):
    found = events(stepping(at_s, size), "tip_angle_deg")[0]
    assert found.trial == "trial_01.csv"
    # Of 3 sigma and more, a sample on the wrong side is told from one on the right one within a few.
    assert found.time_s == pytest.approx(at_s, abs=0.1)


def test_gaps_of_a_sensor_do_not_move_the_time():
    tip = ANGLE + NOISE + 2.0 * (TIME > 5.0)
    tip[100:300] = np.nan
    (found,) = events(covered(ANGLE, tip=tip, seen=AT_REST), "tip_angle_deg")
    assert found.time_s == pytest.approx(5.0, abs=0.1)


def test_a_trial_that_is_too_short_has_no_middle_to_step_in():
    short = np.linspace(0, 90, 80)
    assert events(covered(short, tip=short), "tip_angle_deg") == ()
    assert families(covered(short, tip=short)) == ()


def test_the_step_may_be_of_the_drive_or_of_each_sensor_that_was_read():
    both = covered(ANGLE, tip=ANGLE + NOISE, torque=NOISE, seen=AT_REST)
    assert [(f.place, f.unit) for f in families(both)] == [
        (Place.DRIVE, "deg"),
        (Place.SENSOR, "deg"),
        (Place.SENSOR, "N mm"),
    ]
    assert len(families(stepping(5.0, 1.0))) == 2


def test_a_step_may_stay_in_the_trials_that_follow_it():
    """Of two trials, in the first: it is once there, or for good; in the second, nothing follows."""
    first, second = two_trials(5.0, 1.0), two_trials(5.0, 1.0, number=1)
    names = [family.name for family in families(first)]
    assert names == [
        "slip between drive and needle, once",
        "slip between drive and needle, for good",
        "jump of the tip sensor, once",
        "jump of the tip sensor, for good",
    ]
    assert [family.name for family in families(second)] == [n for n in names if "good" not in n]
    good = families(first)[3]
    assert good.title == "jump of the tip sensor from trial_01.csv on"
    assert good.effect.trial == ""
    changes, stays = good.effect.apply(NOMINAL, 5.0, 0.1, 1.5).free.curves
    assert (changes.trial, stays.trial) == ("trial_01.csv", "trial_02.csv")
    np.testing.assert_allclose(stays.at(np.array([0.0, 0.5, 8.0])), 1.5)


def test_the_time_of_a_step_is_its_middle_but_for_one_at_the_start():
    assert around(5.0, 0.3) == pytest.approx((4.85, 5.15))
    assert around(0.1, 0.6) == pytest.approx((0.0, 0.4))


def test_a_step_is_in_its_own_trial_from_its_time_on():
    (_, jump) = families(stepping(5.0, 1.0))
    assert (jump.says, jump.effect.trial) == ("event", "trial_01.csv")
    when, lasting, step = jump.effect.parameters
    assert when.start[0] == pytest.approx(5.0, abs=0.1)
    assert step.prior_sigma == np.inf
    assert lasting.low < 0.1 < lasting.high
    (curve,) = jump.effect.apply(NOMINAL, 5.0, 0.1, 1.5).free.curves
    assert curve.trial == "trial_01.csv"
    np.testing.assert_allclose(curve.at(np.array([0.0, 4.95, 5.05, 8.0])), [0, 0, 1.5, 1.5])
    x, y = jump.curve(5.0, 0.1, 1.5)
    assert (x[1:3], y[0], y[-1]) == (pytest.approx((4.95, 5.05)), 0.0, 1.5)


def test_the_curve_of_a_slow_event_is_told_in_the_order_of_time():
    x, y = change_between(10.0, 8.0, 0.0, 1.0)
    assert (x, y) == ((0.0, 6.0, 14.0, 16.0), (0.0, 0.0, 1.0, 1.0))
