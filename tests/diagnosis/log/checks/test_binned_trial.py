"""A trial in equal bins, and lagging copies of its signals."""

import numpy as np
import pytest
from analytic_log import STEP_S, TURNS, behind

from diagnosis.log.checks.binned_trial import binned, lagging, misfit
from diagnosis.log.trial import Trial


def test_a_bin_holds_the_mean_of_its_samples():
    rows = TURNS.iloc[:1000].assign(tip_angle_deg=np.arange(1000.0))
    found = binned(Trial(name="turns.csv", table=rows))
    assert found.bin_s == pytest.approx(2 * STEP_S, rel=0.01)
    # Bins are 999 / 500 samples long, so that means are off by up to one sample.
    np.testing.assert_allclose(found.tip_angle_deg, 0.5 + 2 * np.arange(500), atol=1.0)


def test_a_sensor_that_is_absent_is_empty_and_a_bin_without_reading_is_interpolated():
    gone = TURNS["base_torque_n_mm"].where(~TURNS.index.isin(range(100, 110)))
    rows = TURNS.drop(columns="tip_angle_deg").assign(base_torque_n_mm=gone)
    found = binned(Trial(name="turns.csv", table=rows))
    assert found.tip_angle_deg.size == 0
    assert np.isfinite(found.base_torque_n_mm).all()


def test_a_lagging_copy_is_that_of_the_step_by_step_solution():
    base = TURNS["base_angle_deg"].to_numpy()
    # The exact and the explicit step differ by half a step in a lag of fifty: 1 % of 120 deg.
    np.testing.assert_allclose(lagging(base, 0.5, STEP_S), behind(base - base[0], 0.5), atol=1.2)
    np.testing.assert_array_equal(lagging(base, 0.0, STEP_S), base - base[0])


def test_a_lagging_copy_is_explained_by_a_gain_above_zero_only():
    base = TURNS["base_angle_deg"].to_numpy()
    tip = TURNS["tip_angle_deg"].to_numpy()
    same, opposite = misfit(base, tip, STEP_S)
    assert same < 0.02
    assert opposite > 0.6
    assert misfit(base, -tip, STEP_S) == pytest.approx((opposite, same))
