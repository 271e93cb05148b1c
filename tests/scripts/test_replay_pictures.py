"""What was measured, as a replay shows it."""

import numpy as np
from diagnosis_fixtures import trial, turns

from diagnosis.log.trial import Trial
from scripts import replay


def test_a_sensor_that_is_read_in_some_rows_is_shown_as_a_line():
    """Between NaN nothing would be drawn, and nothing logged."""
    one = trial(turns(6.0))
    rare = one["base_angle_deg"].copy()
    rare[np.arange(rare.size) % 10 > 0] = np.nan
    slow = Trial(name=one.name, table=one.table.assign(tip_angle_deg=rare))
    shown = replay._measured(slow)
    assert np.isfinite(shown["measured_tip_deg"][: (rare.size - 1) // 10 * 10]).all()
    np.testing.assert_array_equal(shown["measured_tip_deg"][::10], rare[::10])
    np.testing.assert_array_equal(shown["measured_base_deg"], one["base_angle_deg"])
