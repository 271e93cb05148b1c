"""The motion of the base across gaps."""

import numpy as np
from diagnosis_fixtures import trial, turns

from diagnosis.log.trial import Trial
from diagnosis.prepare.gap_filling import fill_gaps


def with_gap(angle, start_s, end_s):
    """A trial with a tip, and what is left of it beside a gap."""
    whole = trial(angle)
    table = whole.table.assign(tip_angle_deg=0.0)
    kept = (table["time_s"] <= start_s) | (table["time_s"] >= end_s)
    return Trial(name=whole.name, table=table[kept].reset_index(drop=True))


def test_a_gap_is_crossed_as_the_base_went_on_moving():
    time = np.arange(0, 6, 0.01)
    # About a turning point, where a straight line is worst.
    gapped = with_gap(60 * np.sin(2 * np.pi * 0.5 * time), 2.3, 2.55)
    filled = fill_gaps(gapped)
    logged = np.isin(filled["time_s"], gapped["time_s"])
    assert logged.sum() == len(gapped.table)
    assert filled["time_s"].size == time.size
    assert np.isnan(filled["tip_angle_deg"][~logged]).all()
    truth = 60 * np.sin(2 * np.pi * 0.5 * filled["time_s"])
    straight = np.interp(filled["time_s"], gapped["time_s"], gapped["base_angle_deg"])
    # With twelve readings on both sides, 0.245 s each way, the fourth derivative leaves
    # 60 (2 pi 0.5)^4 0.245^4 / 24 = 0.9 deg at the most; a line 60 (2 pi 0.5)^2 0.25^2 / 8 = 4.6 deg.
    assert np.abs(filled["base_angle_deg"] - truth).max() < 0.9
    assert np.abs(straight - truth).max() > 3


def test_readings_after_a_gap_in_a_fast_turn_are_not_used_for_a_second():
    filled = fill_gaps(with_gap(turns(), 1.4, 1.7))  # across the end of a turn of 150 deg/s
    time, tip = filled["time_s"], filled["tip_angle_deg"]
    assert np.isnan(tip[(time > 1.4) & (time < 2.6)]).all()
    assert np.isfinite(tip[(time <= 1.4) | (time > 2.75)]).all()


def test_readings_after_a_gap_while_the_base_holds_are_used():
    filled = fill_gaps(with_gap(turns(), 3.0, 3.3))
    time, tip = filled["time_s"], filled["tip_angle_deg"]
    assert np.isfinite(tip[(time <= 3.0) | (time >= 3.3)]).all()


def test_a_trial_without_gaps_is_left_alone():
    whole = trial(turns())
    assert fill_gaps(whole) is whole
