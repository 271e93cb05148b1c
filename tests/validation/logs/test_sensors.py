"""From ideal signals to a log: noise, quantisation, loss, and the text of its files."""

from dataclasses import replace

import numpy as np
import pytest
import yaml

from validation.logs.sensors import BASE, MEASURED, TIP, TORQUE, as_csv, draw_sensors, measure, rig_yaml
from validation.rig.unmodelled.effect import IdealSignals


@pytest.fixture
def trial(drive):
    """A long trial at rest, of which sensors show noise alone, and its ideal signals."""
    motion = drive(lambda time_s: 0 * time_s, dt=0.0025, end=100.0)
    zero = np.zeros(motion.time_s.size)
    ideal = IdealSignals(
        time_s=motion.time_s, base_deg=zero, torque_n_mm=zero, tip_deg=zero, speed_mm_s=zero
    )
    return replace(motion, per_sample=4), ideal


def test_noise_has_its_standard_deviation(trial, sensors):
    """Of 10 001 samples the standard deviation is known to 0.7 %: 4 sigma is 2.8 %."""
    columns = measure(np.random.default_rng(0), sensors, *trial)
    assert columns["time_s"].size == 10_001
    for signal in (TIP, TORQUE, BASE):
        assert columns[signal].std() == pytest.approx(sensors.noise[signal], rel=0.028)
        assert abs(columns[signal].mean()) < 4 * sensors.noise[signal] / 100


def test_quantised_signals_are_multiples_of_their_step(trial, sensors):
    columns = measure(np.random.default_rng(0), replace(sensors, steps={TIP: 0.75}), *trial)
    counts = columns[TIP] / (0.75 * sensors.noise[TIP])
    assert counts == pytest.approx(np.round(counts), abs=1e-9)
    assert np.unique(np.round(counts)).size > 3


def test_lost_rows_are_few_and_the_first_is_kept(trial, sensors):
    """5 % of 10 001 rows: 500 with a standard deviation of 22."""
    columns = measure(np.random.default_rng(0), replace(sensors, dropped=0.05), *trial)
    assert columns["time_s"][0] == 0.0
    assert 10_001 - columns["time_s"].size == pytest.approx(500, abs=90)
    gaps = measure(np.random.default_rng(0), replace(sensors, dropped=0.0, gaps=True), *trial)
    assert 0.1 < np.diff(gaps["time_s"]).max() < 0.32


def test_a_missing_column_is_absent_and_a_blank_one_has_a_stretch_without_numbers(trial, sensors):
    missing = measure(np.random.default_rng(0), replace(sensors, missing=TORQUE), *trial)
    assert TORQUE not in missing
    assert replace(sensors, missing=TORQUE).shown == (TIP,)
    blank = np.isnan(measure(np.random.default_rng(0), replace(sensors, blank=TIP), *trial)[TIP])
    assert 0.09 < blank.mean() < 0.31
    assert np.count_nonzero(np.diff(blank.astype(int))) <= 2


def test_a_csv_has_a_line_per_row_empty_cells_and_no_negative_zero():
    text = as_csv({"time_s": np.array([0.0, 0.5]), TORQUE: np.array([-0.00001, np.nan])})
    assert text == f"time_s,{TORQUE}\n0.000,0.0000\n0.500,\n"


def test_rig_yaml_states_the_nominal_rig_and_the_claimed_noise(make_rig, sensors):
    rig = make_rig(coulomb_friction={"level": 0.004}, stiffness_error={"scale": 1.2})
    claimed = replace(sensors, claims={**sensors.claims, TIP: 3.0})
    content = yaml.safe_load(rig_yaml(claimed, rig, 2))
    assert content["needle"]["shear_modulus_gpa"] == 27.2
    assert content["tissue"]["damping_n_mm_s_per_mm"] == 0.018
    assert content["sensors"]["tip_angle_noise_deg"] == pytest.approx(1.2)
    assert [trial["file"] for trial in content["trials"]] == ["trial_01.csv", "trial_02.csv"]


def test_drawn_sensors_are_mostly_plain_and_never_lose_both_signals():
    drawn = [draw_sensors(np.random.default_rng(seed)) for seed in range(300)]
    assert all(0.2 <= s.noise[TIP] <= 0.6 and 0.01 <= s.noise[TORQUE] <= 0.02 for s in drawn)
    assert all(s.shown and not (s.missing and s.blank) for s in drawn)
    # 5 % of 300 miss a column: 15 with a standard deviation of 4.
    assert 2 <= sum(s.missing in MEASURED for s in drawn) <= 30
    assert all({"noise", "claims"} <= s.details().keys() for s in drawn)
