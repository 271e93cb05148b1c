"""The low band of smoothed readings: it hardly depends on the filter, and its noise is white."""

import shutil
from dataclasses import replace
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from diagnosis_fixtures import TIP, log_with, trial, turns
from scipy.signal import butter, sosfiltfilt

from diagnosis.criteria.faults import BAND_SHARE
from diagnosis.fitting.fit import fit_effects
from diagnosis.log.rig_log import read_rig_log
from diagnosis.log.trial import SENSORS, Trial
from diagnosis.nominal_replay import replay_nominal
from diagnosis.prepare.low_band import in_low_band, low_passed

SENSOR = "tip_angle_deg"
STEP_S, CORNER_HZ = 0.01, 5.0
TIME_S = STEP_S * np.arange(40_000)
INSIDE = slice(400, -400)
EXAMPLE = Path(__file__).parents[3] / "examples" / "rig-log"


def smoothed(values, corner_hz=CORNER_HZ):
    """Values behind a Butterworth filter of second order that was run twice."""
    return sosfiltfilt(butter(2, corner_hz, fs=1 / STEP_S, output="sos"), values)


def wave(frequency_hz):
    return np.sin(2 * np.pi * frequency_hz * TIME_S)


@pytest.mark.parametrize("frequency_hz", [0.1, 0.5, 0.8])
def test_slow_values_pass(frequency_hz):
    passed = low_passed(TIME_S, wave(frequency_hz), CORNER_HZ)
    # Ripple of a kernel with four lobes on either side.
    np.testing.assert_allclose(passed[INSIDE], wave(frequency_hz)[INSIDE], atol=0.01)


def test_fast_values_do_not():
    assert np.abs(low_passed(TIME_S, wave(4.0), CORNER_HZ)[INSIDE]).max() < 0.01


def test_means_are_kept_up_to_the_ends():
    np.testing.assert_allclose(low_passed(TIME_S, np.full(TIME_S.size, 3.0), CORNER_HZ), 3.0, rtol=1e-3)


def test_rows_that_are_rare_stay_as_they_are():
    rare = 0.2 * np.arange(100)
    values = np.random.default_rng(1).normal(size=100)
    np.testing.assert_array_equal(low_passed(rare, values, CORNER_HZ), values)


def test_two_coefficients_tell_what_a_filter_left():
    rng = np.random.default_rng(1)
    signal = np.cumsum(rng.normal(size=TIME_S.size))  # falls by f^-2, as what drives a needle does
    measured = low_passed(TIME_S, smoothed(signal), CORNER_HZ)
    plain = low_passed(TIME_S, signal, CORNER_HZ)
    second, fourth = (
        plain - low_passed(TIME_S, signal, CORNER_HZ, *one) for one in ((1.0, 0.0), (0.0, 1.0))
    )
    shapes, left = np.stack([second, fourth], axis=1)[INSIDE], (plain - measured)[INSIDE]
    (a, b), *_ = np.linalg.lstsq(shapes, left, rcond=None)
    # 1 / (1 + x^4) = 1 - x^4 + x^8 / (1 + x^4), of which x^4 is a tenth where the band ends, x = 0.56.
    assert (a, b) == (pytest.approx(0.0, abs=0.1), pytest.approx(1.0, abs=0.2))
    assert np.std(left - shapes @ (a, b)) < 0.1 * np.std(left)


@pytest.mark.parametrize("corner_hz", [3.0, 5.0, 9.0])
def test_noise_at_independent_rows_is_white_and_of_the_claimed_size(corner_hz):
    rng = np.random.default_rng(2)
    one = trial(turns(400.0, STEP_S), step=STEP_S)
    noisy = one.table.assign(**{SENSOR: rng.normal(0, TIP, len(one.table))})
    log = replace(log_with(Trial(name=one.name, table=noisy)), smoothed_above_hz={SENSOR: corner_hz})
    low = in_low_band(log)
    left = low.trials[0][SENSOR]
    read = left[np.isfinite(left)]
    apart = np.diff(np.flatnonzero(np.isfinite(left)))
    assert (apart == round(0.5 / (BAND_SHARE * corner_hz * STEP_S))).all()
    bound = 4 / np.sqrt(read.size)  # four standard deviations of a correlation
    for lag in (1, 2, 3):
        # Rows are a whole number apart: corners differ from theirs by up to 4 %, which correlates rows.
        assert abs(np.corrcoef(read[:-lag], read[lag:])[0, 1]) < bound + 0.04
    claimed = low.rig.sensors.tip_angle_noise_deg
    assert np.std(read) == pytest.approx(claimed, rel=4 / np.sqrt(2 * read.size))
    assert low.noise_left == {SENSOR: pytest.approx(claimed / TIP)}


def test_other_logs_and_sensors_are_left_alone():
    one, other = trial(turns(12.0, STEP_S), step=STEP_S), "base_torque_n_mm"
    table = one.table.assign(**{SENSOR: one["base_angle_deg"], other: 0.01 * one["base_angle_deg"]})
    log = log_with(Trial(name=one.name, table=table))
    assert in_low_band(log) is log
    low = in_low_band(replace(log, smoothed_above_hz={SENSOR: CORNER_HZ}))
    assert np.isnan(low.trials[0][SENSOR]).mean() > 0.9
    np.testing.assert_array_equal(low.trials[0][other], log.trials[0][other])
    assert low.rig.sensors.base_torque_noise_n_mm == log.rig.sensors.base_torque_noise_n_mm
    assert low.rig.sensors.tip_angle_noise_deg < log.rig.sensors.tip_angle_noise_deg


def test_readings_that_are_missing_stay_missing():
    one = trial(turns(60.0, STEP_S), step=STEP_S)
    values = np.zeros(len(one.table))
    values[2000:2600] = np.nan
    log = log_with(Trial(name=one.name, table=one.table.assign(**{SENSOR: values})))
    low = in_low_band(replace(log, smoothed_above_hz={SENSOR: CORNER_HZ})).trials[0][SENSOR]
    assert np.isnan(low[2000:2600]).all()
    assert np.isnan(low[: int(1 / (CORNER_HZ * STEP_S))]).all()
    np.testing.assert_allclose(low[np.isfinite(low)], 0.0, atol=1e-12)


@pytest.mark.parametrize("missing", [2, 60])
def test_rows_that_are_missing_change_nothing_beside_them(missing):
    """A few are a line in a smoothed reading; about a longer hole nothing counts."""
    one = trial(turns(60.0, STEP_S), step=STEP_S)
    read = smoothed(20.0 * np.sin(2.0 * one["time_s"]))
    kept = np.ones(len(one.table), bool)
    kept[2000 : 2000 + missing] = False

    def low(rows):
        table = one.table.assign(**{SENSOR: read})[rows].reset_index(drop=True)
        log = log_with(Trial(name=one.name, table=table))
        return in_low_band(replace(log, smoothed_above_hz={SENSOR: CORNER_HZ})).trials[0]

    whole, holed = low(np.ones(kept.size, bool)), low(kept)
    counts = np.isfinite(holed[SENSOR])
    assert np.count_nonzero(np.isfinite(whole[SENSOR])) - np.count_nonzero(counts) < 8
    expected = np.interp(holed["time_s"], one["time_s"], low_passed(one["time_s"], read, CORNER_HZ))
    # A line across 0.6 s is off by 20 (2 rad/s)^2 (0.6 s)^2 / 8 = 3.6 deg, of which lobes have 2 %.
    np.testing.assert_allclose(holed[SENSOR][counts], expected[counts], atol=0.1)
    if missing > 2:
        about = np.abs(holed["time_s"] - 20.3) < 0.5
        assert not counts[about].any()


@pytest.fixture(scope="module")
def smoothed_example(tmp_path_factory):
    """The log of an independent rig that nothing is missing from, smoothed after recording."""
    folder = tmp_path_factory.mktemp("smoothed") / "log"
    shutil.copytree(EXAMPLE, folder)
    for path in folder.glob("*.csv"):
        table = pd.read_csv(path)
        for sensor in SENSORS:
            table[sensor] = smoothed(table[sensor]).round(6)
        table.to_csv(path, index=False)
    return read_rig_log(folder)


def test_a_smoothed_log_of_an_independent_rig_is_told_and_explained(smoothed_example):
    assert set(smoothed_example.smoothed_above_hz) == set(SENSORS)
    assert not any("claims" in said for said in smoothed_example.warnings)
    problem = replay_nominal(smoothed_example).problem
    fit = fit_effects(problem, ())
    assert not problem.noise.colour
    # The first estimate of the noise, fourth differences of rows that are rare, is high by half at most.
    assert 0.6 < fit.gap < 1.1


def test_the_same_without_its_low_band_is_not(smoothed_example):
    """Negative control: readings that are taken for what was read leave what the filter rounded."""
    problem = replay_nominal(replace(smoothed_example, smoothed_above_hz={})).problem
    assert fit_effects(problem, ()).gap > 1.5
