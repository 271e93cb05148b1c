"""The residual on the needle."""

import numpy as np
import pytest
import rerun as rr
from diagnosis_fixtures import trial, turns

from diagnosis.report import needle_view
from diagnosis.report.needle_view import log_needle, needle_bounds
from sim.recording.rerun_table import entries

ONE = trial(turns(2.0), speed=-1.0)  # 200 samples


def test_both_needles_of_a_trial_are_logged_ten_times_a_second(tmp_path):
    path = tmp_path / "needle.rrd"
    stream = rr.RecordingStream("needle-test")
    stream.save(path)
    residuals = {("nominal", "tip_angle_deg"): np.ones(200)}
    log_needle(stream, "trial_1/needle", ONE, residuals)
    stream.disconnect()
    rows = {e.entity: e.rows for e in entries(path) if "needle/" in e.entity}
    shafts = {f"/trial_1/needle/{n}/{p}" for n in ("nominal", "explained") for p in ("free", "inserted")}
    assert set(rows) == {*shafts, "/trial_1/needle/nominal/tip_angle_deg"}
    assert set(rows.values()) == {20}


@pytest.mark.parametrize(
    ("residual", "colour"),
    [(0.0, needle_view._GREY), (0.3, needle_view._GREY), (5.0, needle_view._RED)],
)
def test_noise_is_grey_and_five_times_it_is_red(residual, colour):
    """Means of 10 samples: white noise of one sigma has a mean of 1 / sqrt(10), 0.32."""
    size = residual if residual < 1 else residual / np.sqrt(10)
    values = np.repeat(size, 200)
    shown = np.arange(0, 200, 10)
    expected = np.tile(colour.astype(np.uint8), (20, 1))
    # Sums of ten are scaled to sqrt(10) of a mean: 0.3 is 0.95 sigma, below 1.
    np.testing.assert_array_equal(needle_view._colours(values, shown), expected)


def test_the_view_holds_the_whole_needle():
    bounds = needle_bounds(ONE)
    longest = (ONE["free_mm"] + ONE["inserted_mm"]).max()
    (shown,) = bounds.range.as_arrow_array().to_pylist()
    low, high = shown["x_range"]
    assert low < 0 < longest < high
