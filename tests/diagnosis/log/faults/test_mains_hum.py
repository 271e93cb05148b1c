"""Hum at the mains frequency is found and subtracted; motions and noise are left alone."""

import numpy as np
import pandas as pd
import pytest
from scipy.stats import chi2

from diagnosis.log.faults.mains_hum import without_hum
from diagnosis.log.trial import Trial

TIP, TORQUE = "tip_angle_deg", "base_torque_n_mm"
NOISE = {"base_angle_deg": 0.02, TIP: 0.4, TORQUE: 0.01}


def trial(rate_hz, *, hum_hz=None, size=0.5, column=TIP, seed=1, seconds=20.0, motion=None):
    """A trial with noise of the claimed size, and hum of so many times that."""
    time_s = np.arange(0, seconds, 1 / rate_hz)
    rng = np.random.default_rng(seed)
    turned = (motion or _ramps)(time_s)
    read = {
        "base_angle_deg": turned + rng.normal(0, 0.02, time_s.size),
        TIP: turned - 20 + rng.normal(0, 0.4, time_s.size),
        TORQUE: 0.01 * turned + rng.normal(0, 0.01, time_s.size),
    }
    if hum_hz:
        read[column] += size * NOISE[column] * np.sin(2 * np.pi * hum_hz * time_s + seed)
    table = pd.DataFrame({"time_s": time_s, **read})
    return Trial(name=f"trial_{seed:02d}.csv", table=table)


def _ramps(time_s):
    """Turns of 200 deg/s that begin and end at once: what is least like a line."""
    return 200 * np.abs((time_s % 4) - 2)


@pytest.mark.parametrize(
    ("rate_hz", "hum_hz"),
    [(100, 49.97), (125, 60.03), (200, 50.02), (500, 49.98), (500, 150.06), (73, 60.0)],
)
def test_hum_is_found_and_subtracted(rate_hz, hum_hz):
    humming = [trial(rate_hz, hum_hz=hum_hz, seed=seed) for seed in (1, 2, 3)]
    found, (said,) = without_hum(humming, NOISE)
    assert "tip_angle_deg hums at" in said
    for one, seed in zip(found, (1, 2, 3), strict=True):
        off = one[TIP] - trial(rate_hz, seed=seed)[TIP]
        # Two degrees of freedom of N readings, with a taper, which counts half of them; the frequency
        # is known to a 32nd of 1 / T: at the ends of a trial a tenth of the line is left.
        assert np.sqrt(np.mean(off**2)) < 0.4 * np.sqrt(2 * 2 / off.size) + 0.1 * 0.2
        np.testing.assert_array_equal(one[TORQUE], trial(rate_hz, seed=seed)[TORQUE])


def test_the_grid_has_a_frequency_of_its_own_in_each_trial():
    each_hz = {1: 59.98, 2: 60.0, 3: 60.03}
    humming = [trial(50, hum_hz=own, seed=seed, size=3.0) for seed, own in each_hz.items()]
    found, (said,) = without_hum(humming, NOISE)
    assert "hums at 60.00 Hz" in said
    for one, seed in zip(found, each_hz, strict=True):
        off = one[TIP] - trial(50, seed=seed)[TIP]
        # Of the chi-square of three degrees of freedom, with a taper, which counts half of the readings.
        assert np.sum(off**2) / 0.4**2 < 2 * chi2.isf(1e-3, 3)


def test_a_signal_that_jumps_in_a_gap_leaks_nothing_into_the_line():
    humming, clean = (trial(200, hum_hz=hum, seed=4, motion=_far) for hum in (50.03, None))
    table = humming.table.copy()
    table.loc[1000:1400, TIP] = np.nan
    (found,), _ = without_hum(
        [Trial(name="trial_04.csv", table=table.drop(index=range(2000, 2400)))], NOISE
    )
    off = found[TIP] - clean.table.drop(index=range(2000, 2400))[TIP].to_numpy()
    assert np.sqrt(np.nanmean(off**2)) < 0.4 * np.sqrt(2 * 2 / off.size) + 0.1 * 0.2


def _far(time_s):
    return 500 * np.sin(0.4 * time_s)


@pytest.mark.filterwarnings("error")
def test_a_pause_of_a_week_costs_nothing_and_a_sensor_that_reads_nothing_has_no_hum():
    one = trial(200, hum_hz=50.0)
    late = one.table.assign(time_s=one.table["time_s"] + 604_800.0, **{TORQUE: 0.0})
    both = pd.concat([one.table.assign(**{TORQUE: 0.0}), late], ignore_index=True)
    (found,), (said,) = without_hum([Trial(name=one.name, table=both)], NOISE)
    assert TIP in said
    np.testing.assert_array_equal(found[TORQUE], 0.0)
    clean = np.tile(trial(200)[TIP], 2)
    assert np.sqrt(np.mean((found[TIP] - clean) ** 2)) < 0.4 * np.sqrt(2 * 4 / clean.size) + 0.1 * 0.2


def test_its_frequency_and_size_are_told():
    _, (said,) = without_hum([trial(500, hum_hz=49.98, column=TORQUE, size=2.0)], NOISE)
    assert "base_torque_n_mm hums at 49.98 Hz" in said
    assert "by 0.02:" in said


@pytest.mark.parametrize("rate_hz", [20, 50, 73, 100, 250, 1000])
def test_motion_and_noise_are_no_hum(rate_hz):
    trials = [trial(rate_hz, seed=seed) for seed in (1, 2, 3)]
    assert without_hum(trials, NOISE) == (trials, [])


def test_a_line_that_sampling_folds_to_a_slow_one_is_left():
    trials = [trial(50, hum_hz=49.97)]
    assert without_hum(trials, NOISE) == (trials, [])


def test_a_line_that_the_base_shows_may_be_a_motion():
    def shaken(time_s):
        return _ramps(time_s) + 0.5 * np.sin(2 * np.pi * 50 * time_s)

    trials = [trial(500, motion=shaken)]
    assert without_hum(trials, NOISE) == (trials, [])


def test_empty_cells_and_absent_sensors_stay_so():
    one = trial(200, hum_hz=50.0)
    table = one.table.drop(columns=TORQUE)
    table.loc[100:400, TIP] = np.nan
    (found,), _ = without_hum([Trial(name=one.name, table=table)], NOISE)
    assert np.flatnonzero(np.isnan(found[TIP])).tolist() == list(range(100, 401))
    assert not found.has(TORQUE)
