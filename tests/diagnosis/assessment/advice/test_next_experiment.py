"""The run that would best tell two explanations apart."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import RIG, TIP, fit_of, log_of, problem_of

from diagnosis.assessment.advice.experiments import SAMPLE_S, experiments
from diagnosis.assessment.advice.next_experiment import best_experiment, narrowest, narrowing, separation
from diagnosis.replay.rig_parameters import NOMINAL

BIAS_DEG = 0.05
SURE = [[[1e7]]]  # slopes that leave no doubt of a parameter


def fit_with_bias(slopes):
    """A tip that is off by a constant, known as well as slopes say."""
    scale = fit_of(("tip_angle_bias",)).parameterization.parameters[0].scale
    return fit_of(("tip_angle_bias",), x=[BIAS_DEG / scale], by_trial=[[0.0]], jacobian=slopes)


@pytest.fixture(scope="module")
def problem():
    return problem_of(log_of(NOMINAL, seconds=3.0))


@pytest.fixture(scope="module")
def run(problem):
    return next(experiments(problem.log))


def expected(problem, run):
    """b / sigma in each of N samples, at the log's own rate."""
    per_sample = np.sqrt(SAMPLE_S / problem.log.trials[0].sample_s)
    return BIAS_DEG / problem.noise["tip_angle_deg"] * per_sample * np.sqrt(run.trial.time_s.size)


def test_separation_is_that_of_the_closed_form(problem, run):
    found = separation(problem, run, fit_with_bias(SURE), fit_of((), by_trial=[[0.0]]))
    assert found == pytest.approx(expected(problem, run), rel=1e-4)


def test_what_a_parameter_could_take_back_does_not_separate(problem, run):
    """Known to one standard deviation s, of d standard deviations are left d / sqrt(1 + (d s / b)^2)."""
    scale = fit_of(("tip_angle_bias",)).parameterization.parameters[0].scale
    loose = fit_with_bias([[[scale / BIAS_DEG]]])  # known to the bias itself: s = b
    d = expected(problem, run)
    found = separation(problem, run, loose, fit_of((), by_trial=[[0.0]]))
    assert found == pytest.approx(d / np.sqrt(1 + d**2), rel=1e-4)


def test_the_same_explanation_is_not_told_from_itself(problem, run):
    one = fit_with_bias(SURE)
    assert separation(problem, run, one, one) == pytest.approx(0.0, abs=1e-9)


def test_the_longest_run_is_best_for_a_bias(problem):
    feasible = list(experiments(problem.log))[:4]
    best = best_experiment(problem, fit_with_bias(SURE), fit_of((), by_trial=[[0.0]]), feasible)
    longest = max(feasible, key=lambda e: e.trial.time_s.size)
    assert best.experiment is longest
    assert best.separation == pytest.approx(expected(problem, longest), rel=1e-4)


def test_a_run_narrows_a_mean_by_its_share_of_the_samples(problem, run):
    """Known to the bias b itself, and d standard deviations from 0 in a run: 1 / sqrt(1 + d^2)."""
    scale = fit_of(("tip_angle_bias",)).parameterization.parameters[0].scale
    loose = fit_with_bias([[[scale / BIAS_DEG]]])
    d = expected(problem, run)
    assert narrowing(problem, run, loose, 0) == pytest.approx(1 / np.sqrt(1 + d**2), rel=1e-4)


def test_what_is_certain_is_not_narrowed_and_the_longest_run_narrows_a_bias_most(problem):
    feasible = list(experiments(problem.log))[:4]
    assert narrowing(problem, feasible[0], fit_with_bias(SURE), 0) == pytest.approx(1.0, abs=1e-3)
    scale = fit_of(("tip_angle_bias",)).parameterization.parameters[0].scale
    found = narrowest(problem, fit_with_bias([[[scale / BIAS_DEG]]]), 0, feasible)
    assert found.experiment is max(feasible, key=lambda e: e.trial.time_s.size)


def test_only_sensors_that_the_log_has_count(problem, run):
    one = problem.log.trials[0]
    blind = replace(one, readings={"base_torque_n_mm": one.readings["base_torque_n_mm"]})
    without = replace(problem, log=replace(problem.log, trials=(blind,)))
    found = separation(without, run, fit_with_bias(SURE), fit_of((), by_trial=[[0.0]]))
    assert found == pytest.approx(0.0, abs=1e-9)
    assert RIG.sensors.tip_angle_noise_deg == TIP
