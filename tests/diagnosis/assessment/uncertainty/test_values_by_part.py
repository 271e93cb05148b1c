"""Values by part of a log, against closed forms and logs whose parts are known to differ."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import TIP, fit_of, joined, log_of, log_with, problem_of

from diagnosis.assessment.uncertainty import values_by_part as module
from diagnosis.assessment.uncertainty.partitions import by_motion, trial_by_trial
from diagnosis.assessment.uncertainty.values_by_part import values_by_part
from diagnosis.fitting.fit import fit_effects, nominal_fit
from diagnosis.replay.rig_parameters import NOMINAL


def by_trial(problem, fit):
    (found,) = values_by_part(problem, fit, trial_by_trial(problem, fit))
    return found


ROWS, SCALE = 200, 0.05  # unit of an offset of the torque in a fit, N mm
LEVEL = 3.0  # sigma


@pytest.fixture
def alone(monkeypatch):
    """A problem of three trials, without nuisance; no offset but what is fitted is looked at."""
    monkeypatch.setattr(module, "OFFSETS", ())
    problem = replace(problem_of(log_of(NOMINAL, seconds=2.0)), nuisance=())
    monkeypatch.setattr(
        type(problem), "residuals", lambda own, rigs, **_: [[np.zeros(ROWS)] for _ in range(3)]
    )
    return replace(problem, log=replace(problem.log, trials=problem.log.trials * 3))


def biased(levels, seen=(1.0, 1.0, 1.0), common=0.0):
    """A fit of an offset of the torque to trials that are off by levels; `seen`: its slope in each."""
    slopes = [np.full((ROWS, 1), s) for s in seen]
    by_trial = [np.full(ROWS, s * (common / SCALE - own)) for s, own in zip(seen, levels, strict=True)]
    return fit_of(("torque_bias",), by_trial=by_trial, jacobian=slopes, x=[common / SCALE])


def test_levels_of_trials_are_told_one_by_one(alone):
    levels = (LEVEL, -LEVEL, 0.0)
    (own,) = by_trial(alone, biased(levels))
    assert (own.effect, own.parameter, own.unit) == ("torque_bias", "bias", "N mm")
    assert own.values == pytest.approx([SCALE * level for level in levels], abs=1e-9)
    assert own.gap_common == pytest.approx(LEVEL * np.sqrt(2 / 3))
    assert own.gap_own == pytest.approx(0.0, abs=1e-5)
    assert own.differs


def test_where_all_trials_agree_nothing_differs(alone):
    (own,) = by_trial(alone, biased((LEVEL,) * 3))
    assert own.gap_common == pytest.approx(own.gap_own, abs=1e-5)
    assert not own.differs


def test_what_noise_alone_leaves_differs_by_chance_and_is_not_said_to(alone):
    rng = np.random.default_rng(5)
    left = [rng.normal(size=ROWS) for _ in range(3)]
    noise = fit_of(("torque_bias",), by_trial=left, jacobian=[np.ones((ROWS, 1)) for _ in left], x=[0.0])
    (own,) = by_trial(alone, noise)
    # Two more numbers take off a chi-square of two: of 600 rows 0.003 of the variance on average.
    assert 0.0 < own.share < 0.2
    assert not own.differs


def test_a_trial_in_which_nothing_is_seen_tells_nothing(alone):
    (own,) = by_trial(alone, biased((LEVEL, -LEVEL, LEVEL), seen=(1.0, 1.0, 0.0)))
    assert own.values[2] is None


def test_values_stay_within_their_bounds(alone):
    beyond = 2 * 5.0 / SCALE  # twice the largest offset
    (own,) = by_trial(alone, biased((beyond, 0.0, 0.0)))
    assert own.values[0] == pytest.approx(5.0)


def test_one_trial_has_no_others_and_the_nominal_rig_no_values(alone):
    one = replace(alone, log=replace(alone.log, trials=alone.log.trials[:1]))
    assert by_trial(one, biased((LEVEL,), seen=(1.0,))) == ()
    assert by_trial(alone, nominal_fit([np.zeros(ROWS)] * 3)) == ()


def test_a_sensor_that_was_zeroed_anew_is_found_beside_what_is_fitted():
    torque, tip = 0.1, (1.5, -0.5)  # N mm, deg
    rigs = [replace(NOMINAL, torque_bias_n_mm=torque, tip_bias_deg=own) for own in tip]
    problem = problem_of(joined(*(log_of(rig, seed=i) for i, rig in enumerate(rigs))))
    found = by_trial(problem, fit_effects(problem, ("torque_bias",)))
    rows = problem.log.trials[0].time_s.size
    assert found[0].effect == "tip_angle_bias"
    assert found[0].differs
    # Five standard deviations of a mean; the model is linear in offsets, and stiffness and damping take
    # up to as much again.
    assert found[0].values == pytest.approx(tip, abs=10 * TIP / np.sqrt(rows))
    assert found[0].gap_own == pytest.approx(1.0, abs=5 / np.sqrt(2 * 4 * rows))


def test_a_gain_that_depends_on_the_direction_of_turning_is_found():
    gains = (1.1, 1.2, 1.0)  # turning forwards, backwards, at rest
    log = log_of(NOMINAL)
    (trial,) = log.trials
    rate = np.gradient(trial["base_angle_deg"])
    each = np.select([rate > 0, rate < 0], gains[:2], gains[2])
    table = trial.table.assign(base_torque_n_mm=each * trial["base_torque_n_mm"])
    problem = problem_of(log_with(replace(trial, table=table)))
    fit = fit_effects(problem, ("torque_scale",))
    trials, motions = values_by_part(problem, fit, trial_by_trial(problem, fit), by_motion(problem, fit))
    assert trials == ()
    own = next(one for one in motions if one.effect == "torque_scale")
    assert own.parts == ("turning forwards", "turning backwards", "at rest")
    assert own.differs
    # The rate of the base is averaged over 0.2 s: of turns of 0.8 s and more up to a quarter of the rows
    # count elsewhere, where the gain differs by up to 0.2.
    assert own.values == pytest.approx(gains, abs=0.05)
