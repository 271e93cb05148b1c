"""Several steps of an angle or a reading."""

import numpy as np
import pytest
from diagnosis_fixtures import turns
from free_forms import covered, covered_by

from diagnosis.criteria.freeform import STEPS_MOST
from diagnosis.effects.effect import Place
from diagnosis.freeform.families.in_time.steps import families
from diagnosis.replay.rig_parameters import NOMINAL

SECONDS = 24.0
ANGLE = turns(SECONDS)
TIME = 0.01 * np.arange(ANGLE.size)
NOISE = np.random.default_rng(9).normal(0, 0.25, ANGLE.size)
AT_REST = (ANGLE, np.zeros(ANGLE.size))
AT_S, SIZES = (4.0, 9.5, 10.9, 17.0), (3.0, -2.0, 4.0, -6.0)


def stepped(at_s=AT_S, sizes=SIZES):
    return sum(size * (at <= TIME) for at, size in zip(at_s, sizes, strict=True))


def found_in(*tips):
    """The law of a tip sensor that is off by these in trials of a nominal rig; None: there is none."""
    ranges = covered_by([(ANGLE, ANGLE + NOISE + tip, AT_REST) for tip in tips])
    return next((f for f in families(ranges) if "tip sensor" in f.name), None)


def curves_of(family, number=0):
    values = [p.start[number] for p in family.effect.parameters]
    return family.effect.apply(NOMINAL, *values).free.curves


def test_each_step_has_a_time_and_a_size_of_its_own():
    family = found_in(stepped())
    times = [p for p in family.effect.parameters if p.name.startswith("time")]
    # A step of 8 sigma and more is found within a few samples; it lasts 0.02 s.
    assert [p.start[0] for p in times] == pytest.approx(AT_S, abs=0.06)
    curve = family.effect.apply(NOMINAL, *AT_S, *SIZES).free.curves[0]
    beside = np.min(np.abs(TIME[:, None] - np.array(AT_S)), axis=1) > 0.011
    np.testing.assert_allclose(curve.at(TIME)[beside], stepped()[beside], atol=1e-9)


def test_steps_are_of_their_trials():
    family = found_in(stepped(), stepped((6.0,), (2.5,)), np.zeros(TIME.size))
    assert family.of_each_trial
    assert family.says == "event"
    assert [curve.trial for curve in curves_of(family)] == ["trial_01.csv", "trial_02.csv"]


def test_times_may_pass_one_another_in_a_fit():
    family = found_in(stepped((4.0, 5.0, 12.0), (3.0, -2.0, 4.0)))
    crossed = family.effect.apply(NOMINAL, 5.2, 5.1, 12.0, 3.0, -2.0, 4.0).free.curves[0]
    assert crossed.at(np.array([5.0, 6.0, 13.0])) == pytest.approx([0.0, 1.0, 5.0])


def test_steps_may_be_nearer_to_each_other_than_they_last():
    family = found_in(stepped((4.0, 5.0, 12.0), (3.0, -2.0, 4.0)))
    for near_s in (0.0, 0.015, 0.02 - 1e-7):
        curve = family.effect.apply(NOMINAL, 4.0, 5.0, 5.0 + near_s, 3.0, -2.0, 4.0).free.curves[0]
        assert curve.at(np.array([3.0, 4.5, 6.0])) == pytest.approx([0.0, 3.0, 5.0])


def test_the_curve_is_that_of_the_first_trial():
    family = found_in(stepped())
    x, y = family.curve(*AT_S, *SIZES)
    assert (x[0], y[0]) == (0.0, 0.0)
    assert y[-1] == pytest.approx(sum(SIZES))
    assert (np.diff(x) > 0).all()


def test_one_step_in_a_trial_is_another_law():
    assert found_in(stepped((4.0,), (3.0,)), stepped((9.0,), (3.0,))) is None


@pytest.mark.parametrize("seed", range(3))
def test_noise_does_not_step(seed):
    assert found_in(np.random.default_rng(seed).normal(0, 0.25, TIME.size)) is None


def test_what_swings_is_not_mostly_steps():
    """Cut into as many parts as there may be, a swing of 20 periods is still most of what it was."""
    assert found_in(3.0 * np.sin(2 * np.pi * TIME / SECONDS * 20)) is None


def test_of_many_steps_the_largest_count():
    at_s = np.arange(1.5, 22.5, 1.5)
    sizes = np.where(np.arange(at_s.size) < STEPS_MOST, 5.0, 0.5) * (-1.0) ** np.arange(at_s.size)
    family = found_in(stepped(at_s, sizes))
    assert [p.start[0] for p in family.effect.parameters[:STEPS_MOST]] == pytest.approx(
        at_s[:STEPS_MOST], abs=0.06
    )
    assert len(family.effect.parameters) == 2 * STEPS_MOST


def test_the_drive_and_both_sensors_may_step():
    both = covered(ANGLE, tip=ANGLE + NOISE + stepped(), torque=NOISE + stepped(), seen=AT_REST)
    assert [f.place for f in families(both)] == [Place.DRIVE, Place.SENSOR, Place.SENSOR]
