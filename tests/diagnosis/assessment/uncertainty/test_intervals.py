"""Intervals of parameters, where they have a closed form."""

import math
from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import BASE, TIP, TORQUE, fit_of, log_of, problem_of

from diagnosis.assessment.uncertainty.intervals import covariance, intervals
from diagnosis.criteria.assessment import INTERVAL_Z
from diagnosis.fitting.fit import fit_effects
from diagnosis.replay.rig_parameters import RigParameters

SIGMA = {"tip_angle_deg": TIP, "base_torque_n_mm": TORQUE, "base_angle_deg": 0.0}
SAMPLES = 600


@pytest.fixture(scope="module")
def bias():
    """The fit of a bias alone, on a log that has one, of which it leaves nothing."""
    log = log_of(RigParameters(tip_bias_deg=2.0), seconds=6.0)
    problem = replace(problem_of(log, sigma=SIGMA), nuisance=())
    fit = fit_effects(problem, ("tip_angle_bias",))
    return problem, replace(fit, by_trial=tuple(0.0 * left for left in fit.by_trial))


def intervals_of(problem, fit, change):
    """Intervals of a fit, given what a finer replay changes."""
    return intervals(fit, covariance(problem, fit, change))


def unchanged(samples=SAMPLES):
    """A finer replay that changes nothing."""
    return [dict.fromkeys(("base_torque_n_mm", "tip_angle_deg"), np.zeros(samples))]


def half_width(interval):
    return 0.5 * (interval.high - interval.low)


def test_a_mean_is_known_to_the_noise_over_the_root_of_the_samples(bias):
    found = intervals_of(*bias, unchanged())["tip_angle_bias"]["bias"]
    assert half_width(found) == pytest.approx(INTERVAL_Z * TIP / math.sqrt(SAMPLES), rel=1e-6)
    assert found.low < 2.0 < found.high
    assert found.unit == "deg"


def test_a_fit_that_has_not_come_to_its_minimum_is_uncertain_by_its_next_step(bias):
    problem, fit = bias
    ahead = 0.1
    short = replace(fit, by_trial=tuple(-(j @ np.array([ahead])) for j in fit.jacobian))
    assert short.next_step == pytest.approx([ahead])
    widened = covariance(problem, short, unchanged())[0, 0] - covariance(problem, fit, unchanged())[0, 0]
    assert widened == pytest.approx(ahead**2, rel=1e-6)


def test_numerical_error_of_the_replay_widens_the_interval(bias):
    """A finer replay that moves the tip by c everywhere would move the bias by c."""
    shifted = {"base_torque_n_mm": np.zeros(SAMPLES), "tip_angle_deg": np.full(SAMPLES, 0.2)}
    found = intervals_of(*bias, [shifted])["tip_angle_bias"]["bias"]
    spread = math.hypot(TIP / math.sqrt(SAMPLES), 0.2 * TIP)
    assert half_width(found) == pytest.approx(INTERVAL_Z * spread, rel=1e-6)


def test_noise_of_the_base_widens_the_interval(bias):
    problem, fit = bias
    noisy = replace(problem, noise=replace(problem.noise, sigma=SIGMA | {"base_angle_deg": 20 * BASE}))
    widths = [
        half_width(intervals_of(p, fit, unchanged())["tip_angle_bias"]["bias"]) for p in (problem, noisy)
    ]
    assert widths[1] > 1.02 * widths[0]


def test_ends_stay_within_bounds():
    problem = replace(problem_of(log_of(RigParameters(), seconds=2.0), sigma=SIGMA), nuisance=())
    fit = fit_effects(problem, ("tip_sensor_delay",))
    found = intervals_of(problem, fit, unchanged(200))["tip_sensor_delay"]["delay"]
    assert found.low >= 0.0


def test_an_angle_is_told_in_the_half_periods_about_0(bias):
    problem, _ = bias
    start = np.array([math.log(0.001), 35.0])  # 350 deg
    slopes = np.random.default_rng(1).normal(size=(2 * SAMPLES, 2))
    residual = problem.residuals([fit_of(("needle_curvature",), x=start).parameterization.rig(start)])
    fit = fit_of(("needle_curvature",), x=start, jacobian=[slopes], by_trial=residual[0])
    phase = intervals_of(problem, fit, unchanged())["needle_curvature"]["phase"]
    assert phase.value == pytest.approx(-10.0)
    assert phase.low < phase.value < phase.high


def test_nothing_that_is_open_has_no_interval(bias):
    problem, _ = bias
    assert intervals_of(problem, fit_of(()), [{}]) == {}
