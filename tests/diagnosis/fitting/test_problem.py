"""What a fit rests on."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import joined, log_of, problem_of

from diagnosis.fitting.problem import FitProblem
from diagnosis.log.trial import SENSORS
from diagnosis.prepare.noise.drift import AllowedDrift
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


def test_samples_are_the_readings_that_residuals_are_of():
    problem = problem_of(log_of(NOMINAL, seconds=2.0))
    (one,) = problem.log.trials
    lost = {
        **one.readings,
        "tip_angle_deg": np.where(one.time_s < 1.0, np.nan, one.readings["tip_angle_deg"]),
    }
    holed = replace(problem, log=replace(problem.log, trials=(replace(one, readings=lost),)))
    assert holed.samples < problem.samples
    for own in (problem, holed):
        assert own.samples == sum(run[0].size for run in own.residuals([NOMINAL]))


def test_a_motion_that_is_read_again_is_off_by_what_smoothing_leaves_of_the_noise():
    quiet = problem_of(log_of(NOMINAL, seconds=4.0))
    sigma = 0.02
    noise = replace(quiet.noise, sigma={**quiet.noise.sigma, "base_angle_deg": sigma})
    problem = replace(quiet, noise=noise)
    again = problem.read_again(np.random.default_rng(0))
    assert isinstance(again, FitProblem)
    off = again.log.trials[0].base_motion_deg - problem.log.trials[0].base_motion_deg
    assert 0.0 < np.sqrt(np.mean(off**2)) < sigma


def test_a_coarse_encoder_reads_a_rest_off_by_one_rounding_error():
    """Up to half a step, the same for all of the rest, and uniform: step / sqrt(12)."""
    step, rng = 0.5, np.random.default_rng(0)
    quiet = problem_of(log_of(NOMINAL, seconds=4.0))
    log = replace(quiet.log, rounded={"base_angle_deg": step / np.sqrt(12)})
    noise = replace(quiet.noise, sigma={**quiet.noise.sigma, "base_angle_deg": step / np.sqrt(12)})
    problem = replace(quiet, log=log, noise=noise)
    rests = problem.log.trials[0].time_s < 0.5
    offs = []
    for _ in range(40):
        again = problem.read_again(rng).log.trials[0].base_motion_deg[rests]
        assert np.ptp(again) < 1e-9
        offs.append(again[0] - problem.log.trials[0].base_motion_deg[0])
    assert np.abs(offs).max() <= 0.5 * step
    assert np.std(offs) == pytest.approx(step / np.sqrt(12), rel=0.25)


@pytest.mark.parametrize("sensor", SENSORS)
def test_a_sensor_that_may_drift_does_not_count_a_line_of_its_size(sensor):
    """The cost of a line of one sigma is about (1 / D)^2, not the number of its samples."""
    problem = problem_of(log_of(NOMINAL, seconds=12.0))
    sigma = problem.noise[sensor]
    (one,) = problem.log.trials
    line = sigma * one.time_s / one.time_s[-1]
    off = {**one.readings, sensor: one.readings[sensor] + line}
    drifted = replace(problem, log=replace(problem.log, trials=(replace(one, readings=off),)))

    def cost(some):
        return float(np.sum(some.residuals([NOMINAL])[0][0] ** 2))

    as_it_is = cost(drifted) - cost(problem)
    noise = problem.noise.with_drift(sensor, AllowedDrift(size=2.0 * sigma))
    allowed = cost(replace(drifted, noise=noise)) - cost(replace(problem, noise=noise))
    assert as_it_is > 100.0
    assert abs(allowed) < 0.1 * as_it_is


def quick_turns_deg(time_s):
    """Turns of least jerk, whose corners smoothing rounds off."""
    turns = [(90.0, 1.0, 0.8), (-140.0, 4.0, 1.5), (70.0, 8.0, 0.5)]
    shares = [(turn, np.clip((time_s - start) / lasts, 0, 1)) for turn, start, lasts in turns]
    return sum(turn * (10 * s**3 - 15 * s**4 + 6 * s**5) for turn, s in shares)


def test_a_sharpened_motion_read_again_is_off_as_the_smoothed_one_is():
    """Slow error of smoothing, in blocks of half a second: what bias makes of it shows only there."""
    sigma, rng = 0.02, np.random.default_rng(1)
    quiet = problem_of(log_of(NOMINAL, seconds=12.0))
    noise = replace(quiet.noise, sigma={**quiet.noise.sigma, "base_angle_deg": sigma})
    (one,) = quiet.log.trials
    true = quick_turns_deg(one.time_s)

    def moving(motion):
        trial = replace(one, base_motion_deg=motion)
        return replace(quiet, noise=noise, log=replace(quiet.log, trials=(trial,)))

    def slow(problem, other):
        off = problem.log.trials[0].base_motion_deg - other.log.trials[0].base_motion_deg
        return np.sqrt(np.mean(off[: off.size // 50 * 50].reshape(-1, 50).mean(axis=1) ** 2))

    truth = moving(true)
    smoothed = [truth.read_again(rng) for _ in range(8)]
    as_it_is = np.mean([slow(own, truth) for own in smoothed])
    alike = np.mean([slow(own.sharpened().read_again(rng), own.sharpened()) for own in smoothed])
    without = np.mean([slow(own.read_again(rng), own) for own in smoothed])
    assert 0.75 < alike / as_it_is < 1.35
    assert without < alike
