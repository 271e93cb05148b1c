"""A log with fewer samples, on which a coarse needle answers as a fine one does."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import NOISE, RIG, log_of, prepared, problem_of
from scipy.signal import lfilter

from diagnosis.fitting import decimation
from diagnosis.fitting.decimation import decimated, decimated_noise, gap_on_the_log
from diagnosis.log.trial import SENSORS
from diagnosis.nominal_replay import replay_nominal
from diagnosis.prepare.noise.autoregression import Autoregression
from diagnosis.prepare.noise.noise_colour import ColouredPart, NoiseColour
from diagnosis.prepare.noise.sensor_noise import Noise
from diagnosis.replay.replay import predict, residuals
from diagnosis.replay.resolution import COARSE
from diagnosis.replay.rig_parameters import NOMINAL, RigParameters

RIGS = [
    RigParameters(kinetic_n_mm_per_mm=0.0015),
    RigParameters(backlash_deg=4.0),
    RigParameters(tissue_stiffness_n_mm_per_rad_per_mm=0.02, tissue_time_constant_s=1),
]


@pytest.mark.parametrize("rig", RIGS)
def test_a_decimated_log_weighs_an_explanation_as_the_log_does(rig):
    """Sums of squares of what the nominal rig misses agree within 5 %, and truth fits both."""
    nominal = replay_nominal(log_of(rig, speed=-1.0))
    both = (nominal.problem, decimated(nominal.problem, nominal.predictions))
    assert both[1].resolution is COARSE
    assert both[1].log.trials[0].time_s.size < 0.3 * both[0].log.trials[0].time_s.size
    wrong, right = (
        [sum(float(r[0] @ r[0]) for r in problem.residuals([one])) for problem in both]
        for one in (NOMINAL, rig)
    )
    samples = sum(np.isfinite(both[1].log.trials[0].readings[s]).sum() for s in SENSORS)
    gain = [w - r for w, r in zip(wrong, right, strict=True)]
    assert gain[1] == pytest.approx(gain[0], rel=0.05)
    # A window's mean shares its outer samples with its neighbours: 0.9 of the noise is left.
    assert right[1] / samples < 1.1


@pytest.mark.parametrize("every", [5, 50])
def test_readings_of_a_rare_sensor_weigh_as_they_do_on_the_log(every):
    """A window holds one reading of them at most, which is no mean of four: it would weigh fourfold."""
    log = log_of(RIGS[0], speed=-1.0)
    rare = np.arange(len(log.trials[0].table)) % every > 0
    log.trials[0].table.loc[rare, "tip_angle_deg"] = np.nan
    log.trials[0].table["base_torque_n_mm"] = np.nan
    nominal = replay_nominal(log)
    both = (nominal.problem, decimated(nominal.problem, nominal.predictions))
    wrong, right = (
        [sum(float(r[0] @ r[0]) for r in problem.residuals([one])) for problem in both]
        for one in (NOMINAL, RIGS[0])
    )
    gain = [w - r for w, r in zip(wrong, right, strict=True)]
    assert gain[1] == pytest.approx(gain[0], rel=0.05)
    assert right[1] < 1.1 * right[0]  # less where a window between two readings has a part of both


@pytest.mark.parametrize(
    ("seconds", "error_sigma", "step_s"),
    [
        (12.0, 0.4, 0.04),
        (12.0, 0.6, 0.03),
        (12.0, 3.0, 0.02),
        (200.0, 0.02, 0.08),
        (200.0, 0.11, 0.06),
        (200.0, 0.16, 0.05),
        (200.0, 0.4, 0.04),
    ],
)
def test_windows_are_as_wide_as_the_coarse_needle_can_follow(seconds, error_sigma, step_s, monkeypatch):
    """Its error, here that of windows of 40 ms, goes with their square; a long log has wider ones."""

    def with_error(problem, _, __, resolution):
        return resolution, error_sigma * (resolution.step_s / 0.04) ** 2

    monkeypatch.setattr(decimation, "_decimated", with_error)
    problem = problem_of(log_of(NOMINAL, seconds=seconds), sigma=NOISE.sigma)
    assert decimated(problem, ()).step_s == pytest.approx(step_s)


def test_what_the_coarse_nominal_rig_misses_is_the_mean_of_what_the_fine_one_does():
    nominal = replay_nominal(log_of(RigParameters(kinetic_n_mm_per_mm=0.001)))
    coarse = decimated(nominal.problem, nominal.predictions)
    fine, rare = nominal.problem.log.trials[0], coarse.log.trials[0]
    left = residuals(rare, predict(coarse.log.rig, rare, [NOMINAL], COARSE)[0], coarse.noise)
    tip = left[rare.time_s.size :] * coarse.noise["tip_angle_deg"]
    missed = fine.readings["tip_angle_deg"] - nominal.predictions[0]["tip_angle_deg"]
    for i in (50, 120, 200):  # trapezoidal mean over five samples: 40 ms
        about = missed[4 * i - 2 : 4 * i + 3]
        assert tip[i] == pytest.approx((about.sum() - 0.5 * (about[0] + about[-1])) / 4, rel=1e-6)


@pytest.mark.parametrize("end", [4, 11], ids=["a few", "most"])
def test_windows_without_readings_stay_empty(end):
    log = log_of(NOMINAL)
    table = log.trials[0].table
    table.loc[(table["time_s"] > 3) & (table["time_s"] < end), "tip_angle_deg"] = np.nan
    nominal = replay_nominal(log)
    rare = decimated(nominal.problem, nominal.predictions).log.trials[0]
    inside = (rare.time_s > 3.05) & (rare.time_s < end - 0.05)
    assert np.isnan(rare.readings["tip_angle_deg"][inside]).all()
    assert np.isfinite(rare.readings["base_torque_n_mm"]).all()


def test_a_torque_at_the_tip_is_decimated_with_the_rest():
    nominal = replay_nominal(log_of(NOMINAL, seconds=3.0))
    one = nominal.problem.log.trials[0]
    driven = replace(one, tip_torque_n_mm=0.1 * one.time_s)
    log = replace(nominal.problem.log, trials=(driven,))
    rare = decimated(replace(nominal.problem, log=log), nominal.predictions).log.trials[0]
    np.testing.assert_allclose(rare.tip_torque_n_mm, 0.1 * rare.time_s)
    assert not rare.logged.any()
    assert prepared(log_of(NOMINAL, seconds=3.0).trials[0]).tip_torque_n_mm is None


@pytest.mark.parametrize(("share", "time_s"), [(1.0, 0.02), (0.5, 0.1), (1.0, 0.2)])
def test_coloured_noise_keeps_its_density_at_low_frequencies(share, time_s):
    """Power per hertz is variance times step times density: 10 ms steps become 40 ms ones."""
    log = log_of(NOMINAL)
    rare = decimated(replay_nominal(log).problem, replay_nominal(log).predictions).log
    ready = replay_nominal(log).problem.log
    colour = NoiseColour.of(share=share, correlation_time_s=time_s)
    before = Noise(sigma={"tip_angle_deg": 0.3}, colour={"tip_angle_deg": colour})
    after = decimated_noise(before, ready, rare)
    power = [
        noise["tip_angle_deg"] ** 2 * noise.colour["tip_angle_deg"].density(step_s) * step_s
        for noise, step_s in ((before, 0.01), (after, 0.04))
    ]
    assert power[1] == pytest.approx(power[0], rel=0.01)  # 301 windows for 1200 samples
    assert after.colour["tip_angle_deg"].parts[0].correlation_time_s == time_s


@pytest.mark.parametrize(("frequency_hz", "kept"), [(4.0, True), (16.0, False)])
def test_an_oscillation_keeps_its_density_and_is_white_where_it_is_fast(frequency_hz, kept):
    log = log_of(NOMINAL)
    ready = replay_nominal(log).problem.log
    rare = decimated(replay_nominal(log).problem, replay_nominal(log).predictions).log
    part = ColouredPart(share=0.7, correlation_time_s=0.05, frequency_hz=frequency_hz)
    colour = {"tip_angle_deg": NoiseColour(parts=(part,))}
    before = Noise(sigma={"tip_angle_deg": 0.3}, colour=colour)
    after = decimated_noise(before, ready, rare)
    assert ("tip_angle_deg" in after.colour) is kept
    power = [
        noise["tip_angle_deg"] ** 2
        * (noise.colour["tip_angle_deg"].density(step_s) if noise.colour else 1.0)
        * step_s
        for noise, step_s in ((before, 0.01), (after, 0.04))
    ]
    assert power[1] == pytest.approx(power[0], rel=0.01)


def test_an_autoregression_keeps_its_density_and_is_that_of_means():
    log = log_of(NOMINAL)
    ready = replay_nominal(log).problem.log
    rare = decimated(replay_nominal(log).problem, replay_nominal(log).predictions).log
    lags = np.arange(5)
    # cov(k) = r^k (cos(k t) + s sin(k t)) of the process of second order 1.5, -0.8
    pulse = lfilter([1], [1, -1.5, 0.8], np.eye(1, 4000)[0])
    shown = np.array([pulse[: pulse.size - lag] @ pulse[lag:] for lag in lags]) / (pulse @ pulse)
    own = Autoregression(autocovariances=tuple(shown), step_s=0.01)
    before = Noise(sigma={"tip_angle_deg": 0.3}, colour={"tip_angle_deg": own})
    after = decimated_noise(before, ready, rare)
    power = [
        noise["tip_angle_deg"] ** 2 * noise.colour["tip_angle_deg"].density * step_s
        for noise, step_s in ((before, 0.01), (after, 0.04))
    ]
    assert power[1] == pytest.approx(power[0], rel=0.01)
    assert after.colour["tip_angle_deg"] == own.of_so_many(4)


def test_a_decimated_log_with_coloured_noise_weighs_an_explanation_as_the_log_does():
    rig = RigParameters(kinetic_n_mm_per_mm=0.0015)
    nominal = replay_nominal(log_of(rig, speed=-1.0))
    colour = NoiseColour.of(share=0.7, correlation_time_s=0.1)
    noise = replace(nominal.problem.noise, colour=dict.fromkeys(SENSORS, colour))
    problem = replace(nominal.problem, noise=noise)
    both = (problem, decimated(problem, nominal.predictions))
    wrong, right = (
        [sum(float(r[0] @ r[0]) for r in one.residuals([rigs])) for one in both]
        for rigs in (NOMINAL, rig)
    )
    gain = [w - r for w, r in zip(wrong, right, strict=True)]
    assert gain[1] == pytest.approx(gain[0], rel=0.1)


def test_a_window_that_readings_begin_in_has_the_mean_of_what_was_read():
    nominal = replay_nominal(log_of(NOMINAL, seconds=3.0))
    (one,) = nominal.problem.log.trials
    unused = one.time_s < 0.505
    off = {s: np.where(unused, np.nan, p + 7.0) for s, p in _read(nominal).items()}
    log = replace(nominal.problem.log, trials=(replace(one, readings=off),))
    rare = decimated(replace(nominal.problem, log=log), nominal.predictions).log.trials[0]
    (bare,) = predict(RIG, replace(rare, readings={}), [NOMINAL], COARSE)
    left = rare.readings["tip_angle_deg"] - bare["tip_angle_deg"]
    # Windows of 40 ms: those that end before the first reading are empty, the next half full.
    assert np.isnan(left[rare.time_s < 0.48]).all()
    np.testing.assert_allclose(left[rare.time_s >= 0.52], 7.0, atol=1e-9)
    known = left[np.isfinite(left)]
    np.testing.assert_allclose(known, 7.0, atol=1e-9)


def _read(nominal):
    return {s: nominal.predictions[0][s] for s in ("tip_angle_deg", "base_torque_n_mm")}


@pytest.mark.parametrize(("noise_sigma", "step_s"), [(1.0, 0.04), (0.1, 0.02)])
def test_windows_are_shorter_where_the_coarse_needle_does_not_follow(noise_sigma, step_s):
    """With a tenth of the noise, what the coarse needle misses is ten times as much of it."""
    nominal = replay_nominal(log_of(NOMINAL))
    sigma = {sensor: noise_sigma * own for sensor, own in nominal.problem.noise.sigma.items()}
    quiet = replace(nominal.problem, noise=replace(nominal.problem.noise, sigma=sigma))
    coarse = decimated(quiet, nominal.predictions)
    assert coarse.resolution.step_s == step_s
    assert coarse.log.trials[0].sample_s == pytest.approx(step_s)


@pytest.mark.parametrize(
    ("noise_sigma", "seconds", "step_s"),
    [(5.0, 160.0, 0.08), (0.5, 160.0, 0.05), (5.0, 140.0, 0.04)],
    ids=["long, and followed closely", "long, and not so", "short"],
)
def test_windows_are_longer_of_a_long_log_that_the_coarse_needle_follows_closely(
    noise_sigma, seconds, step_s
):
    nominal = replay_nominal(log_of(NOMINAL, seconds=seconds))
    sigma = {sensor: noise_sigma * own for sensor, own in nominal.problem.noise.sigma.items()}
    problem = replace(nominal.problem, noise=replace(nominal.problem.noise, sigma=sigma))
    coarse = decimated(problem, nominal.predictions)
    assert coarse.resolution.step_s == step_s
    assert coarse.log.trials[0].sample_s == pytest.approx(step_s)


def test_what_means_leave_beyond_noise_is_less_on_the_log_itself():
    """Of means over four readings each: a quarter of the square. Noise stays noise."""
    problem = problem_of(log_of(NOMINAL, seconds=4.0), sigma=NOISE.sigma)
    (trial,) = problem.log.trials
    every_fourth = np.arange(trial.time_s.size) % 4 == 0
    readings = {s: np.where(every_fourth, own, np.nan) for s, own in trial.readings.items()}
    rare = replace(problem.log, trials=(replace(trial, readings=readings),))
    coarse = replace(problem, log=rare)
    assert gap_on_the_log(np.sqrt(1.0 + 4 * 0.21), problem, coarse) == pytest.approx(np.sqrt(1.21))
    assert gap_on_the_log(0.9, problem, coarse) == 1.0
