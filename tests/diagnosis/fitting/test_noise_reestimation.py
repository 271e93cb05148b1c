"""Noise as the best explanation leaves it."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import BASE, TIP, TORQUE, fit_of, joined, log_of, problem_of
from scipy.signal import lfilter

from diagnosis.criteria.fitting import NOISE_TRUST, SCATTER
from diagnosis.effects import LIBRARY
from diagnosis.fitting.noise_reestimation import (
    in_units_of,
    reestimated_noise,
    rescaled,
    slow_where_coloured,
    with_colour,
)
from diagnosis.prepare.noise.noise_colour import NoiseColour
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


def test_less_is_believed_where_smoothed_readings_count_in_rare_rows(problem):
    trials = (replace(problem.log.trials[0], smoothed_above_hz={"tip_angle_deg": 4.0}),)
    smoothed = replace(problem, log=replace(problem.log, trials=trials))
    noise = reestimated_noise(smoothed, fit_of((), by_trial=[left(0.5, 0.5)]))
    assert noise["base_torque_n_mm"] == pytest.approx((1 - NOISE_TRUST) * TORQUE)
    assert noise["tip_angle_deg"] / TIP == pytest.approx(0.5, abs=0.5 * 3 * np.sqrt(0.75 / SAMPLES))


@pytest.mark.parametrize(("more", "corner_hz"), [(2.0, 4.0), (1.2, 4.0), (2.0, 40.0)])
def test_a_claim_may_be_that_of_readings_after_they_were_smoothed(problem, more, corner_hz):
    """Of white noise a share of 2 corner / rate passes: so much larger it was before."""
    trials = (replace(problem.log.trials[0], smoothed_above_hz={"tip_angle_deg": corner_hz}),)
    smoothed = replace(problem, log=replace(problem.log, trials=trials))
    noise = reestimated_noise(smoothed, fit_of((), by_trial=[left(more, more)]))
    most = (1 + NOISE_TRUST) / np.sqrt(2 * corner_hz * problem.log.trials[0].sample_s)
    error = more * 3 * np.sqrt(0.75 / SAMPLES)
    assert noise["tip_angle_deg"] / TIP == pytest.approx(min(more, most), abs=error)
    assert noise["base_torque_n_mm"] == pytest.approx((1 + NOISE_TRUST) * TORQUE)


@pytest.mark.parametrize("weight", [0.5, 0.9])
def test_readings_whose_prediction_errs_are_no_noise(problem, weight):
    """Half of the readings of the tip leave less, and count only if they have most of their weight."""
    rows = left(1.0, 1.0)
    rows[SAMPLES + SAMPLES // 2 :] *= 0.8
    weights = np.repeat([1.0, weight], [SAMPLES // 2, SAMPLES - SAMPLES // 2])
    trials = (replace(problem.log.trials[0], weights={"tip_angle_deg": weights}),)
    weighted = replace(problem, log=replace(problem.log, trials=trials))
    noise = reestimated_noise(weighted, fit_of((), by_trial=[rows]))
    expected = 1.0 if weight < 0.8 else np.sqrt((1 + 0.8**2) / 2)
    assert noise["tip_angle_deg"] / TIP == pytest.approx(max(expected, 1 - NOISE_TRUST), abs=0.05)
    assert noise["base_torque_n_mm"] / TORQUE == pytest.approx(1.0, abs=0.05)


def test_heavy_tails_add_to_what_is_believed(problem):
    """Of a core of the first estimate: then as large as first differences are."""
    tails = 0.75 * np.random.default_rng(4).standard_t(3, size=SAMPLES)
    rows = np.concatenate([tails, left(1, 1)[SAMPLES:]])
    noise = reestimated_noise(problem, fit_of((), by_trial=[rows]))
    expected = np.sqrt(np.mean(np.diff(tails) ** 2) / 2)
    assert expected > 1 + NOISE_TRUST
    assert noise["base_torque_n_mm"] / TORQUE == pytest.approx(expected)
    assert noise["tip_angle_deg"] / TIP == pytest.approx(1.0, abs=3 * np.sqrt(0.75 / SAMPLES))


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


def test_a_trial_of_which_nothing_is_left_keeps_its_slopes_of_no_row(problem):
    """All of a recording that began late may be left out."""
    (trial,) = problem.log.trials
    none = {sensor: np.full(values.size, np.nan) for sensor, values in trial.readings.items()}
    unread = replace(trial, name="trial_02.csv", readings=none)
    both = replace(problem, log=replace(problem.log, trials=(trial, unread)))
    slopes = (np.ones((2 * SAMPLES, 3)), np.zeros((0, 3)))
    noise = replace(problem.noise, sigma=SIGMA | {"tip_angle_deg": 1.05 * TIP})
    assert [own.shape for own in in_units_of(both, slopes, noise)] == [(2 * SAMPLES, 3), (0, 3)]


def coloured(problem, share=0.8, time_s=0.05):
    """The problem with a colour of the tip angle."""
    colour = {"tip_angle_deg": NoiseColour.of(share=share, correlation_time_s=time_s)}
    noise = replace(problem.noise, colour=colour, white=problem.noise.sigma)
    return replace(problem, noise=noise)


@pytest.fixture(scope="module")
def long():
    return problem_of(joined(*(log_of(NOMINAL, seed=i) for i in range(4))), sigma=SIGMA)


def correlated(problem, share, time_s, seed=5):
    """Residuals with white noise of the torque and coloured noise of the tip angle, whitened."""
    rng = np.random.default_rng(seed)
    truth = NoiseColour.of(share=share, correlation_time_s=time_s)
    raw = []
    for trial in problem.log.trials:
        tip = truth.restored(trial.time_s, rng.normal(size=trial.time_s.size))
        raw.append(np.concatenate([rng.normal(size=tip.size), tip]))
    plain = replace(problem, noise=problem.noise.uncoloured)
    return fit_of((), by_trial=in_units_of(plain, raw, problem.noise))


def test_the_colour_is_found_again_in_what_the_best_leaves(long):
    problem = coloured(long, share=0.8, time_s=0.05)
    noise = reestimated_noise(problem, correlated(problem, share=0.6, time_s=0.1))
    found = noise.colour["tip_angle_deg"]
    # 48 s hold 240 independent values of the coloured part: three times 9 % of its power.
    assert found.share == pytest.approx(0.6, abs=0.12)
    power = (noise["tip_angle_deg"] / TIP) ** 2 * found.share * found.parts[0].correlation_time_s
    assert power == pytest.approx(0.6 * 0.1, rel=0.45)
    assert "base_torque_n_mm" not in noise.colour
    (line,) = noise.notes
    assert line.startswith("tip_angle_deg: ")
    assert line.endswith("ms; the diagnosis allows for it")


def test_a_colour_that_the_best_does_not_leave_was_none(long):
    problem = coloured(long)
    noise = with_colour(problem, correlated(problem, share=0.0, time_s=0.1))
    assert noise.colour == {}
    assert noise.sigma == SIGMA


def test_units_of_another_colour_are_whitened_anew(long):
    problem = coloured(long)
    fit = correlated(problem, share=0.8, time_s=0.05)
    plain = in_units_of(problem, fit.by_trial, problem.noise.uncoloured)
    assert np.std(np.diff(plain[0][SAMPLES:])) < 0.8 * np.std(np.diff(fit.by_trial[0][SAMPLES:]))
    np.testing.assert_array_equal(plain[0][:SAMPLES], fit.by_trial[0][:SAMPLES])
    again = in_units_of(replace(problem, noise=problem.noise.uncoloured), plain, problem.noise)
    np.testing.assert_allclose(again[2], fit.by_trial[2], atol=1e-10)


def test_what_is_slow_is_seen_over_seconds_where_noise_is_coloured(long):
    """One sigma of a wave of 8 s: little beside the slow part of 25 samples, much over 2 s."""
    problem = coloured(long, share=1.0, time_s=0.2)
    fit = correlated(problem, share=1.0, time_s=0.2)
    (floor,) = slow_where_coloured(problem, fit.by_trial).values()
    assert floor.slow < floor.slow_limit
    wave = [
        np.concatenate([np.zeros(SAMPLES), np.sin(2 * np.pi * trial.time_s / 8)])
        for trial in problem.log.trials
    ]
    plain = replace(problem, noise=problem.noise.uncoloured)
    moved = in_units_of(plain, wave, problem.noise)
    left = [r + m for r, m in zip(fit.by_trial, moved, strict=True)]
    (floor,) = slow_where_coloured(problem, left).values()
    assert floor.slow > floor.slow_limit


@pytest.mark.parametrize(
    ("beside", "outlier", "swings"), [(0.0, 0.0, True), (0.0, 40.0, True), (3.0, 0.0, False)]
)
def test_noise_swings_where_little_else_is_left(beside, outlier, swings, problem):
    """AR(2) noise of 12 Hz: alone, with an outlier, and beside what a model lacks, which is three times
    as much, and slow."""
    rng, step_s = np.random.default_rng(6), 0.01
    kept, turn = np.exp(-step_s / 0.05), 2 * np.pi * 12.0 * step_s
    one = lfilter([1.0], [1.0, -2 * kept * np.cos(turn), kept**2], rng.normal(size=SAMPLES + 500))[500:]
    time_s = step_s * np.arange(SAMPLES)
    torque = one / one.std() + beside * np.sqrt(2) * np.sin(2 * np.pi * 0.3 * time_s)
    torque[SAMPLES // 2] += outlier
    wide = replace(problem, log=replace(problem.log, trials=problem.log.trials * 3))
    by_trial = [np.concatenate([torque, rng.normal(size=SAMPLES)])] * 3
    colour = with_colour(wide, fit_of((), by_trial=by_trial)).colour["base_torque_n_mm"]
    assert any(part.frequency_hz for part in colour.parts) is swings
