"""Parts of a log."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import fit_of, joined, log_of, problem_of

from diagnosis.assessment.uncertainty.partitions import MOTIONS, by_motion, trial_by_trial
from diagnosis.replay.rig_parameters import NOMINAL


@pytest.fixture(scope="module")
def problem():
    """Two trials: one turns forth and back, and rests; one never turns."""
    return problem_of(joined(log_of(NOMINAL), log_of(NOMINAL, angle=np.zeros(800))))


def fit_to(problem):
    rows = [sum(np.isfinite(own).sum() for own in t.readings.values()) for t in problem.log.trials]
    return fit_of(("torque_bias",), by_trial=[np.zeros(n) for n in rows])


def test_each_trial_is_a_part(problem):
    parts = trial_by_trial(problem, fit_to(problem))
    assert parts.names == ("trial_01.csv", "trial_02.csv")
    assert [set(own) for own in parts.of_rows] == [{0}, {1}]


def test_a_row_belongs_to_what_the_base_does_then(problem):
    parts = by_motion(problem, fit_to(problem))
    assert parts.names == MOTIONS
    moving, still = parts.of_rows
    assert set(still) == {MOTIONS.index("at rest")}
    one = problem.log.trials[0]
    turning = [np.gradient(one.base_motion_deg)] * 2  # rows of both sensors
    forth = np.concatenate(turning) > 0.1
    agree = (moving == MOTIONS.index("turning forwards")) == forth
    assert agree.mean() > 0.97  # but for 0.2 s about the ends of turns


def test_a_motion_that_no_trial_has_is_no_part(problem):
    resting = replace(problem, log=replace(problem.log, trials=problem.log.trials[1:]))
    parts = by_motion(resting, fit_to(resting))
    assert parts.names == ("at rest",)
    assert [set(own) for own in parts.of_rows] == [{0}]
