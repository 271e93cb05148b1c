"""The residual by signal, phase, frequency, depth and time."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import NOISE, TIP, TORQUE, log_with, trial, turns

from diagnosis.criteria.residuals import BANDS_HZ
from diagnosis.in_sigma import in_sigma
from diagnosis.log.trial import Trial
from diagnosis.replay.prediction import Prediction
from diagnosis.residuals.residual_breakdown import ResidualBreakdown, band_name, residual_breakdown
from diagnosis.residuals.trial_residual import trial_residuals


@pytest.fixture(scope="module")
def found():
    """A tip that is off by five noises while the base holds after its second turn, and no torque."""
    rng = np.random.default_rng(3)
    motion = trial(turns())
    table = motion.table.assign(base_torque_n_mm=0.0, tip_angle_deg=0.0)
    predicted = Prediction(
        tip_angle_deg=rng.normal(0, TIP, len(table)), base_torque_n_mm=rng.normal(0, TORQUE, len(table))
    )
    off = (table["time_s"] >= 5.8) & (table["time_s"] < 9)
    predicted = replace(predicted, tip_angle_deg=predicted.tip_angle_deg + 5 * TIP * off.to_numpy())
    log = log_with(Trial(name=motion.name, table=table))
    return residual_breakdown(trial_residuals(log, [predicted], NOISE))


def test_a_gap_is_found_in_its_signal(found):
    # 1 is white noise, good to 1 / sqrt(2 N) = 2 % for 1200 samples; the share of 3.2 s in 12 adds.
    assert found.signal["base_torque_n_mm"] == pytest.approx(1, abs=0.06)
    assert found.signal["tip_angle_deg"] == pytest.approx(np.sqrt(1 + 25 * 3.2 / 12), rel=0.05)


def test_a_gap_is_found_in_its_phase(found):
    assert found.phase["holding"] > 1.2 * found.phase["turning"]
    assert "translating" not in found.phase


def test_a_gap_is_found_in_its_stretch(found):
    name, gap = found.worst
    assert name == "trial_01.csv, 5–10 s"
    assert gap == pytest.approx(np.sqrt(1 + 25 * 3.2 / 5 / 2), rel=0.05)


def test_a_gap_is_found_in_its_band_and_at_its_depth(found):
    bands = {low: value for low, _, value in found.band_hz}
    assert bands[0.1] > 2
    assert bands[10.0] < 1.2
    assert found.depth_mm[0][0] == 90.0


def parts(signal, phase):
    """A breakdown with these two parts."""
    return ResidualBreakdown(signal=signal, phase=phase, band_hz=[], depth_mm=[], time_s=[])


def test_the_last_band_ends_where_the_samples_do():
    assert [band_name(*band) for band in BANDS_HZ][-2:] == ["1 to 10 Hz", "above 10 Hz"]


def test_the_words_name_the_largest_signal_and_phase_of_the_numbers(found):
    tip, reversal = found.signal["tip_angle_deg"], found.phase["reversal"]
    assert tip == max(found.signal.values())
    assert reversal == max(found.phase.values())
    expected = f"largest in tip_angle_deg ({in_sigma(tip)}) and after a reversal ({in_sigma(reversal)})"
    assert found.largest == expected
    held = parts({"base_torque_n_mm": 3.0, "tip_angle_deg": 2.0}, {"turning": 1.0, "holding": 4.0})
    assert held.largest == "largest in base_torque_n_mm (3.00 σ) and while holding (4.00 σ)"


def test_without_phases_the_words_name_the_signal_alone():
    assert parts({"tip_angle_deg": 2.0}, {}).largest == "largest in tip_angle_deg (2.00 σ)"
    assert parts({}, {}).largest == "nowhere"
