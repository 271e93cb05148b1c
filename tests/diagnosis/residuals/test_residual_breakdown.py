"""The residual by signal, phase, frequency, depth and time."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import NOISE, TIP, TORQUE, log_with, trial, turns

from diagnosis.residuals.residual_breakdown import base_rate, phases, residual_breakdown
from diagnosis.log.trial import Trial
from diagnosis.replay.replay import Prediction


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
    return residual_breakdown(log_with(Trial(name=motion.name, table=table)), [predicted], NOISE)


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


def test_the_rate_of_a_ramp_is_its_slope():
    time = np.arange(0, 5, 0.01)
    rate = base_rate(time, 30 * time)
    np.testing.assert_allclose(rate[30:-30], 30.0)


def test_phases_are_those_of_the_motion():
    masks = phases(trial(turns(), speed=-1.0))
    time = trial(turns())["time_s"]
    assert masks["turning"][(time > 1.15) & (time < 1.45)].all()
    assert masks["holding"][(time > 2) & (time < 4.5)].all()
    assert masks["reversal"][(time > 5.2) & (time < 6.8)].all()
    assert not masks["reversal"][time < 4.8].any()
    assert masks["translating"].all()
    assert masks["retracting"].all()
