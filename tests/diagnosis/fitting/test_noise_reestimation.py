"""Noise as the best explanation leaves it."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import BASE, TIP, TORQUE, fit_of, log_of, problem_of

from diagnosis.criteria import NOISE_TRUST, SCATTER
from diagnosis.effects import LIBRARY
from diagnosis.fitting.noise_reestimation import reestimated_noise, rescaled
from diagnosis.replay.rig_parameters import NOMINAL

SIGMA = {"tip_angle_deg": TIP, "base_torque_n_mm": TORQUE, "base_angle_deg": BASE}
SAMPLES = 1200


@pytest.fixture(scope="module")
def problem():
    return problem_of(log_of(NOMINAL), sigma=SIGMA)


def left(torque, tip):
    """White residuals in the order of a trial's sensors."""
    rng = np.random.default_rng(1)
    return np.concatenate([torque * rng.normal(size=SAMPLES), tip * rng.normal(size=SAMPLES)])


def test_each_sensor_is_told_by_its_own_residual(problem):
    noise = reestimated_noise(problem, fit_of((), by_trial=[left(1.05, 0.97)]))
    # First differences of N samples: sqrt(3 / (4 N)) of standard error, 2.5 %.
    error = 3 * np.sqrt(0.75 / SAMPLES)
    assert noise["base_torque_n_mm"] / TORQUE == pytest.approx(min(1.05, 1 + NOISE_TRUST), abs=error)
    assert noise["tip_angle_deg"] / TIP == pytest.approx(0.97, abs=error)
    assert noise["base_torque_n_mm"] / TORQUE != noise["tip_angle_deg"] / TIP
    assert noise["base_angle_deg"] == BASE


def test_what_is_far_off_is_not_believed(problem):
    noise = reestimated_noise(problem, fit_of((), by_trial=[left(2.0, 0.5)]))
    assert noise["base_torque_n_mm"] == pytest.approx((1 + NOISE_TRUST) * TORQUE)
    assert noise["tip_angle_deg"] == pytest.approx((1 - NOISE_TRUST) * TIP)


def test_a_fit_in_units_of_another_noise_is_what_a_fit_to_it_would_be(problem):
    scales = tuple(LIBRARY[name] for name in SCATTER)
    x = np.array([0.01, -0.02])
    rng = np.random.default_rng(2)
    fit = fit_of(
        (), by_trial=[left(1, 1)], jacobian=[rng.normal(size=(2 * SAMPLES, 2))], x=x, nuisance=scales
    )
    noise = replace(problem.noise, sigma=SIGMA | {"tip_angle_deg": 1.05 * TIP})
    again = rescaled(fit, problem, noise)
    np.testing.assert_array_equal(again.by_trial[0][:SAMPLES], fit.by_trial[0][:SAMPLES])
    np.testing.assert_allclose(again.by_trial[0][SAMPLES:], fit.by_trial[0][SAMPLES:] / 1.05)
    np.testing.assert_allclose(again.jacobian[0][SAMPLES:], fit.jacobian[0][SAMPLES:] / 1.05)
    prior = sum((x[i] / SCATTER[e.name]) ** 2 for i, e in enumerate(scales))
    assert again.cost == pytest.approx(float(again.by_trial[0] @ again.by_trial[0]) + prior)
