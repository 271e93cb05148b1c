"""Readings that were smoothed after recording are found, with the corner of the filter; no others."""

import numpy as np
import pandas as pd
import pytest
from scipy.signal import butter, lfilter, savgol_filter, sosfiltfilt

from diagnosis.log.faults.smoothed import smoothed_above_hz
from diagnosis.log.trial import Trial

TIP, TORQUE = "tip_angle_deg", "base_torque_n_mm"
NOISE = {"base_angle_deg": 0.02, TIP: 0.4, TORQUE: 0.01}


def trials(process=lambda values, _rate_hz: values, *, rate_hz=100.0, noise=1.0, places=4, seconds=30.0):
    """Trials of ramps with corners, whose tip was processed after recording, and rounded."""
    return [_trial(process, seed, rate_hz, noise, places, seconds) for seed in (1, 2, 3)]


def _trial(process, seed, rate_hz, noise, places, seconds):
    rng = np.random.default_rng(seed)
    time_s = np.arange(0.0, seconds, 1 / rate_hz)
    turned = 60.0 * np.abs((time_s + 0.7 * seed) % 4 - 2)
    read = {
        "base_angle_deg": turned,
        TIP: np.round(process(turned + noise * rng.normal(0, 0.4, time_s.size), rate_hz), places),
        TORQUE: 0.01 * turned + rng.normal(0, 0.01, time_s.size),
    }
    return Trial(name=f"trial_{seed}.csv", table=pd.DataFrame({"time_s": time_s, **read}))


def butterworth(corner_hz, order=2):
    return lambda values, rate_hz: sosfiltfilt(
        butter(order, corner_hz, fs=rate_hz, output="sos"), values
    )


def mean_of(rows):
    return lambda values, _: np.convolve(
        np.pad(values, rows // 2, "edge"), np.ones(rows) / rows, "valid"
    )


@pytest.mark.parametrize("rate_hz", [50.0, 100.0, 500.0])
@pytest.mark.parametrize("corner_hz", [4.0, 10.0])
@pytest.mark.parametrize("order", [2, 4])
def test_the_corner_of_a_filter_that_was_run_twice(rate_hz, corner_hz, order):
    found, (said,) = smoothed_above_hz(trials(butterworth(corner_hz, order), rate_hz=rate_hz), NOISE)
    assert set(found) == {TIP}
    # Run twice, |H|^2 is a half where tan(pi f dt) / tan(pi corner dt) to the power 2 n is sqrt(2) - 1.
    # Levels of some 60 segments scatter by an eighth, and there are ten about the corner at least, where
    # they change by 4 n times as much as the frequency: to 2 %. Motion, no power law, adds some.
    half = np.tan(np.pi * corner_hz / rate_hz) * (np.sqrt(2) - 1) ** (1 / (2 * order))
    assert found[TIP] == pytest.approx(rate_hz / np.pi * np.arctan(half), rel=0.06)
    assert said.startswith("tip_angle_deg was smoothed after recording")


@pytest.mark.parametrize("rows", [9, 15])
def test_the_corner_of_a_moving_mean(rows):
    found, _ = smoothed_above_hz(trials(mean_of(rows)), NOISE)
    # sin^2(x) / x^2 is a half at 0.443 of its first zero, 1 / (rows dt).
    assert found == {TIP: pytest.approx(0.443 * 100 / rows, abs=0.443 * 0.4)}


def test_savgols_filter_is_found():
    found, _ = smoothed_above_hz(trials(lambda values, _: savgol_filter(values, 21, 2)), NOISE)
    assert 2.5 < found[TIP] < 6.0  # its half is at 5.5 Hz, that of a mean with its zeros is lower


def test_a_claim_of_the_smoothed_readings_does_too():
    claimed = NOISE | {TIP: 0.4 * np.sqrt(2 * 4.0 / 100)}
    assert set(smoothed_above_hz(trials(butterworth(4.0)), claimed)[0]) == {TIP}


def correlated(values, _rate_hz):
    """Noise correlated over 20 rows in place of white, of the same size."""
    rng = np.random.default_rng(5)
    share = np.exp(-1 / 20)
    noise = rng.normal(0, 0.4 * np.sqrt(1 - share**2), values.size)
    return values + lfilter([1.0], [1.0, -share], noise)


def humming(values, rate_hz):
    return values + 2.0 * np.sin(2 * np.pi * 41.0 / rate_hz * np.arange(values.size))


@pytest.mark.parametrize(
    "log",
    [
        trials(),
        trials(rate_hz=20.0),
        trials(rate_hz=20.0, seconds=8.0),
        trials(noise=0.05),  # another unit, or a wrong claim
        *(trials(noise=0.05, seconds=seconds) for seconds in (2.0, 3.0, 5.0)),
        trials(noise=0.0, places=6),  # simulated without noise
        trials(noise=0.0, places=2),
        trials(correlated, noise=0.0),
        trials(humming, noise=0.3),
        trials(lambda values, rate_hz: lfilter([0.2], [1.0, -0.8], values)),  # an amplifier's low pass
    ],
    ids=[
        *("white", "slow", "short", "quiet", "2 s", "3 s", "5 s"),
        "exact",
        "rounded",
        "correlated",
        "humming",
        "causal",
    ],
)
def test_what_was_not_smoothed(log):
    assert smoothed_above_hz(log, NOISE) == ({}, [])


def test_a_sensor_that_one_trial_shows_as_it_is_was_not_smoothed():
    smooth, plain = trials(butterworth(4.0)), trials()
    assert smoothed_above_hz([*smooth[:2], plain[2]], NOISE) == ({}, [])


def test_nothing_is_claimed_or_read():
    assert smoothed_above_hz(trials(butterworth(4.0)), NOISE | {TIP: 0.0}) == ({}, [])
    empty = [Trial(name="a.csv", table=one.table.assign(**{TIP: np.nan})) for one in trials()]
    assert smoothed_above_hz(empty, NOISE) == ({}, [])


def of_correlated_noise(rate_hz, seed, seconds=16.0):
    """A trial of ramps whose tip has correlated noise of 33 ms, and no other."""
    rng = np.random.default_rng(seed)
    kept = np.exp(-1 / rate_hz / 0.033)

    def noisy(values, _):
        return values + lfilter([0.4 * np.sqrt(1 - kept**2)], [1, -kept], rng.normal(size=values.size))

    return _trial(noisy, seed, rate_hz, 0.0, 4, seconds)


@pytest.mark.parametrize(
    "rates_hz", [(1000.0,), (1000.0, 1000.0), (1000.0, 100.0), (1000.0, 250.0, 100.0)]
)
@pytest.mark.parametrize("seed", range(5))
def test_correlated_noise_of_trials_at_several_rates_was_not_smoothed(rates_hz, seed):
    """In cycles per row it falls elsewhere at each rate: no mixture of them is the spectrum of one."""
    each = [of_correlated_noise(rate_hz, 10 * seed + n) for n, rate_hz in enumerate(rates_hz)]
    assert smoothed_above_hz(each, NOISE) == ({}, [])
