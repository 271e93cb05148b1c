"""What a fit rests on."""

import numpy as np
from diagnosis_fixtures import joined, log_of, problem_of

from diagnosis.replay.replay import predict, residuals
from diagnosis.replay.rig_parameters import NOMINAL, RigParameters


def test_residuals_are_trial_by_trial_and_then_rig_by_rig():
    problem = problem_of(joined(*(log_of(NOMINAL, seconds=2.0, seed=i) for i in (0, 1))))
    rigs = [NOMINAL, RigParameters(damping_scale=1.1)]
    found = problem.residuals(rigs)
    assert [len(trial) for trial in found] == [2, 2]
    for trial, own in zip(problem.log.trials, found, strict=True):
        for rig, left in zip(rigs, own, strict=True):
            alone = predict(problem.log.rig, trial, [rig], problem.resolution)[0]
            np.testing.assert_array_equal(left, residuals(trial, alone, problem.noise))
