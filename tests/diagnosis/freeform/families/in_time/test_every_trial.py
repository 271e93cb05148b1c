"""Something that happened once in every trial."""

import numpy as np
import pytest
from diagnosis_fixtures import turns
from free_forms import covered_by

from diagnosis.freeform.families.in_time.events import events
from diagnosis.freeform.families.in_time.every_trial import families
from diagnosis.replay.rig_parameters import NOMINAL

ANGLE = turns(8.0)
TIME = 0.01 * np.arange(ANGLE.size)
NOISE = np.random.default_rng(9).normal(0, 0.25, ANGLE.size)


def test_one_trial_has_no_event_in_every_trial():
    tip, still = ANGLE + NOISE + 2.0 * (TIME > 5.0), (ANGLE, np.zeros(ANGLE.size))
    assert families(covered_by([(ANGLE, tip, still)])) == ()
    names = [family.name for family in families(covered_by(2 * [(ANGLE, tip, still)]))]
    assert names == [
        "slip between drive and needle once in every trial",
        "jump of the tip sensor once in every trial",
    ]


def every_trial(at_s, lasting=(8.0, 8.0, 8.0), sizes=(3.0, 3.0, 3.0, 3.0)):
    """The last family of a log whose tip sensor jumps at times of its trials; and its events."""
    trials = []
    for when, last, size in zip(at_s, lasting, sizes, strict=False):
        angle = ANGLE[: round(last / 0.01)]
        time = 0.01 * np.arange(angle.size)
        still = (angle, np.zeros(angle.size))
        trials.append((angle, angle + NOISE[: angle.size] + size * (time > when), still))
    ranges = covered_by(trials)
    return families(ranges)[-1], events(ranges, "tip_angle_deg")


def times_of(family, values):
    """By trial, when the curves of a family step."""
    curves = family.effect.apply(NOMINAL, *values).free.curves
    return {curve.trial: np.mean(curve.places) for curve in curves}


def started(family, number):
    return [p.start[number] for p in family.effect.parameters]


@pytest.mark.parametrize(
    ("at_s", "lasting"), [((2.0, 5.0, 3.0), (8.0, 8.0, 8.0)), ((3.2, 1.9, 2.4), (8.0, 5.0, 6.0))]
)
def test_a_step_in_every_trial_begins_at_a_time_of_its_own(at_s, lasting):
    family, _ = every_trial(at_s, lasting)
    assert (family.says, family.effect.trial) == ("event", "")
    names = [f"trial_{i + 1:02d}.csv" for i in range(len(at_s))]
    expected = dict(zip(names, at_s, strict=True))
    assert times_of(family, started(family, 0)) == pytest.approx(expected, abs=0.1)


def test_times_that_are_far_off_a_line_are_in_the_range_of_its_coordinates():
    """Steps at 5, 50 and 30 s of trials of 60 s: a fit starts where they were found, and may move."""
    angle, rng = turns(60.0), np.random.default_rng(2)
    time, still = 0.01 * np.arange(angle.size), (angle, np.zeros(angle.size))
    at_s = {"trial_01.csv": 5.0, "trial_02.csv": 50.0, "trial_03.csv": 30.0}
    tips = (angle + rng.normal(0, 0.25, angle.size) + 3.0 * (time > at) for at in at_s.values())
    family = families(covered_by([(angle, tip, still) for tip in tips]))[-1]
    begin = started(family, 0)
    assert times_of(family, begin) == pytest.approx(at_s, abs=0.1)
    each = zip(family.effect.parameters, begin, strict=True)
    assert all(p.low < start < p.high for p, start in each)


def test_times_in_proportion_to_the_trials_need_no_coordinates_but_those_of_a_line():
    family, _ = every_trial((3.2, 2.0, 2.4), (8.0, 5.0, 6.0))
    expected = {"trial_01.csv": 3.2, "trial_02.csv": 2.0, "trial_03.csv": 2.4}
    assert times_of(family, started(family, 1)) == pytest.approx(expected, abs=0.1)
    off = [p for p in family.effect.parameters if p.name.startswith("rest")]
    assert len(off) == 1
    assert off[0].start[1] == 0.0


def test_one_trial_that_is_off_does_not_move_the_line():
    family, _ = every_trial((4.0, 4.0, 1.0, 4.0), (8.0,) * 4)
    expected = {f"trial_{i:02d}.csv": 4.0 for i in range(1, 5)}
    assert times_of(family, started(family, 1)) == pytest.approx(expected, abs=0.1)


def test_the_time_of_a_step_in_every_trial_is_told_of_the_trial_that_shows_it_most():
    family, found = every_trial((2.0, 5.0, 3.0))
    assert family.title == "jump of the tip sensor once in every trial"
    assert family.x_unit == f"s of {found[0].trial}"


def test_the_step_of_every_trial_is_looked_for_with_either_sign():
    family, found = every_trial((2.0, 5.0, 3.0))
    step = family.effect.parameters[-1]
    assert step.name == "step"
    assert {np.sign(start) for start in step.start} == {1.0, -1.0}
    assert all(len(p.start) == len(step.start) for p in family.effect.parameters)
    values = [*started(family, 0)[:-1], 2.5]
    curves = family.effect.apply(NOMINAL, *values).free.curves
    assert {curve.values for curve in curves} == {(0.0, 2.5)}
    x, y = family.curve(*values)
    first = dict((m.trial, m.time_s) for m in found)[curves[0].trial]
    assert (np.mean(x[1:3]), y[-1]) == (pytest.approx(first, abs=1e-9), 2.5)


def test_a_step_may_go_the_other_way_in_some_of_the_trials():
    family, found = every_trial((2.0, 5.0, 3.0), sizes=(3.0, -3.0, 3.0))
    curves = family.effect.apply(NOMINAL, *started(family, 0)[:-1], 2.5).free.curves
    steps = {curve.trial: curve.values[-1] for curve in curves}
    sign = 1.0 if found[0].trial != "trial_02.csv" else -1.0
    expected = {"trial_01.csv": 2.5, "trial_02.csv": -2.5, "trial_03.csv": 2.5}
    assert steps == {trial: sign * step for trial, step in expected.items()}
