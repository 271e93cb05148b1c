"""What a fit rests on."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import NOISE, RIG, joined, log_of, problem_of

from diagnosis.fitting.problem import FitProblem
from diagnosis.prepare.prepared_log import PreparedLog
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


def test_noise_changes_as_another_problems_did():
    halved = replace(NOISE, sigma={s: 0.5 * own for s, own in NOISE.sigma.items()})
    problem = FitProblem(log=PreparedLog(rig=RIG, trials=()), noise=halved, nuisance=())
    before = replace(NOISE, sigma=dict.fromkeys(NOISE.sigma, 1.0))
    after = replace(NOISE, sigma={**before.sigma, "tip_angle_deg": 1.06})
    changed = problem.renoised(after, before=before)
    assert changed.noise["tip_angle_deg"] == pytest.approx(1.06 * halved["tip_angle_deg"])
    assert changed.noise["base_torque_n_mm"] == halved["base_torque_n_mm"]
    assert changed.log is problem.log


def test_an_encoder_without_noise_stays_without():
    quiet = replace(NOISE, sigma=NOISE.sigma | {"base_angle_deg": 0.0})
    problem = FitProblem(log=PreparedLog(rig=RIG, trials=()), noise=quiet, nuisance=())
    assert problem.renoised(quiet, before=quiet).noise.sigma == quiet.sigma
