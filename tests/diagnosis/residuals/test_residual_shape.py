"""The shape of the residual of a log."""

import numpy as np
import pytest
from diagnosis_fixtures import NOISE, TIP, TORQUE, log_with, trial, turns
from scipy.signal import lfilter

from diagnosis.log.trial import Trial
from diagnosis.replay.prediction import Prediction
from diagnosis.residuals.motion import base_rate, direction
from diagnosis.residuals.residual_shape import residual_shape
from diagnosis.residuals.trial_residual import trial_residuals


def shape_of(torque, tip, *, size=1200):
    """The shape of residuals / sigma that one trial leaves."""
    motion = trial(turns())
    measured = {"base_torque_n_mm": torque, "tip_angle_deg": tip}
    table = motion.table.assign(**{name: v for name, v in measured.items() if v is not None})
    nothing = Prediction(tip_angle_deg=np.zeros(size), base_torque_n_mm=np.zeros(size))
    log = log_with(Trial(name=motion.name, table=table))
    return residual_shape(trial_residuals(log, [nothing], NOISE))


@pytest.fixture(scope="module")
def noise():
    return np.random.default_rng(4).normal(size=(2, 1200))


def test_noise_is_at_the_floor_everywhere_and_nothing_leads(noise):
    found = shape_of(TORQUE * noise[0], TIP * noise[1])
    gaps = [gap for part in (found.base_angle_deg, found.rate_deg_s) for _, gap in part]
    # Of 40 readings or more a root mean square is good to 11 %.
    np.testing.assert_allclose(gaps, 1.0, atol=4 * 0.11)
    assert found.leads.signal == ""
    assert set(found.spectrum) == {"base_torque_n_mm", "tip_angle_deg"}
    for own in found.autocorrelation.values():
        assert abs(own.lag_one_correlation) < 2 * own.white_limit


def test_a_gap_is_found_where_the_base_turns_fast(noise):
    motion = trial(turns())
    rate = base_rate(motion["time_s"], motion["base_angle_deg"])
    found = shape_of(TORQUE * (noise[0] + 5 * (rate > 100)), None)
    gaps = dict(found.rate_deg_s)
    fastest = max(gaps)
    assert fastest > 100
    assert gaps[fastest] > 4
    assert max(gap for rate, gap in gaps.items() if rate < 30) < 1.5


def test_a_gap_is_found_at_its_angle(noise):
    angle = trial(turns())["base_angle_deg"]
    along = dict(shape_of(TORQUE * (noise[0] + 5 * (angle > 80)), None).base_angle_deg)
    assert along[max(along)] > 4
    assert max(gap for angle, gap in along.items() if angle < 70) < 1.5


def test_a_gap_is_found_after_the_reversal(noise):
    back = direction(trial(turns())) < 0
    found = shape_of(None, TIP * (noise[1] + 5 * back))
    assert [gap > 4 for _, gap in found.since_reversal_s] == [True] * len(found.since_reversal_s)
    assert max(place for place, _ in found.since_reversal_s) > 2


def test_one_sensor_has_a_memory_and_leads_nothing(noise):
    slow = lfilter([1.0], [1, -0.9], noise[0])
    found = shape_of(TORQUE * slow, None)
    assert found.leads is None
    assert set(found.autocorrelation) == {"base_torque_n_mm"}
    # Good to sqrt((1 - 0.81) / 1200) = 0.013, less a bias of 0.002.
    assert found.autocorrelation["base_torque_n_mm"].lag_one_correlation == pytest.approx(0.9, abs=0.05)
