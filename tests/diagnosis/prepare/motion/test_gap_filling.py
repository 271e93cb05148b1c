"""The motion of the base across gaps."""

import numpy as np
import pytest
from diagnosis_fixtures import BASE, trial, turns

from diagnosis.log.trial import Trial
from diagnosis.prepare.motion.gap_filling import fill_gaps


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
    filled = fill_gaps(gapped, BASE)
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


def test_a_known_torque_at_the_tip_goes_on_as_smoothly_as_the_base():
    """A line would cut off its top, of which a trial with dry friction under load was told."""
    time = np.arange(0, 6, 0.01)
    gapped = with_gap(60 * np.sin(2 * np.pi * 0.5 * time), 2.3, 2.55)
    load = 2.0 * np.sin(2 * np.pi * 0.5 * gapped["time_s"])
    filled = fill_gaps(Trial(name=gapped.name, table=gapped.table.assign(tip_torque_n_mm=load)), BASE)
    truth = 2.0 * np.sin(2 * np.pi * 0.5 * filled["time_s"])
    # As the base: 2 (2 pi 0.5)^4 0.245^4 / 24 = 0.03 N mm at the most; a line leaves 0.15.
    np.testing.assert_allclose(filled["tip_torque_n_mm"], truth, atol=0.03)
    assert "tip_torque_n_mm" not in fill_gaps(gapped, BASE).table


def test_readings_after_a_gap_in_a_fast_turn_are_not_used_for_a_second():
    filled = fill_gaps(with_gap(turns(), 1.4, 1.7), BASE)  # across the end of a turn of 150 deg/s
    time, tip = filled["time_s"], filled["tip_angle_deg"]
    assert np.isnan(tip[(time > 1.4) & (time < 2.6)]).all()
    assert np.isfinite(tip[(time <= 1.4) | (time > 2.75)]).all()


def test_a_needle_that_remembers_twice_as_long_is_waited_for_twice_as_long():
    """Its slowest mode decays exponentially: the wait is proportional to its time constant."""

    def waited_s(memory_s):
        filled = fill_gaps(with_gap(turns(), 1.4, 1.7), BASE, memory_s)
        return filled["time_s"][np.isnan(filled["tip_angle_deg"])].max() - 1.69

    assert waited_s(0.6) > 1.1  # more than the second that any needle is given
    assert abs(waited_s(1.2) - 2 * waited_s(0.6)) < 0.03  # samples are 0.01 s apart


def test_readings_after_a_gap_while_the_base_holds_are_used():
    filled = fill_gaps(with_gap(turns(), 3.0, 3.3), BASE)
    time, tip = filled["time_s"], filled["tip_angle_deg"]
    assert np.isfinite(tip[(time <= 3.0) | (time >= 3.3)]).all()


TIME = np.arange(0, 6, 0.01)
STOPPED_DEG = 80 * np.clip(TIME - 2.0, 0.0, 0.5)  # a turn of 80 deg/s that ends after half a second


@pytest.mark.parametrize(
    ("start_s", "end_s"), [(2.55, 2.7), (2.3, 2.46), (2.45, 2.58)], ids=["after", "in", "at the end of"]
)
def test_beside_the_end_of_a_turn_the_base_does_not_overshoot(start_s, end_s):
    """By less than the presliding angle of 0.1 deg, which turns dry friction near the chuck around."""
    filled = fill_gaps(with_gap(STOPPED_DEG, start_s, end_s), BASE)
    inside = (filled["time_s"] > start_s) & (filled["time_s"] < end_s)
    path, noise = filled["base_angle_deg"][inside], 4 * BASE
    truth = np.interp(filled["time_s"][inside], TIME, STOPPED_DEG)
    assert truth[0] - noise < path.min()
    assert path.max() < truth[-1] + noise
    assert np.abs(path - truth).max() < (1.0 if start_s == 2.45 else noise)
    assert np.diff(path).min() > -noise


def test_a_turn_back_in_a_gap_goes_beyond_its_ends():
    there_and_back = 60 - 60 * np.abs(TIME - 2.5)
    filled = fill_gaps(with_gap(there_and_back, 2.45, 2.55), BASE)
    assert filled["base_angle_deg"].max() > 59.5


def test_a_trial_without_gaps_is_left_alone():
    whole = trial(turns())
    assert fill_gaps(whole, BASE) is whole


def test_a_short_gap_costs_no_reading_but_its_own():
    """Ends of a turn of 150 deg/s in a gap of 50 ms: the corner is where both lines meet."""
    filled = fill_gaps(with_gap(turns(), 1.575, 1.625), BASE)
    time, tip = filled["time_s"], filled["tip_angle_deg"]
    assert np.isfinite(tip[(time < 1.575) | (time > 1.625)]).all()
    truth = np.interp(time, 0.01 * np.arange(turns().size), turns())
    np.testing.assert_allclose(filled["base_angle_deg"], truth, atol=0.01)


def test_lost_rows_are_filled_as_the_motion_was():
    time = np.arange(0, 6, 0.01)
    smooth = 60 * np.sin(2 * np.pi * 0.5 * time)
    whole = trial(smooth + np.random.default_rng(1).normal(0, BASE, time.size))
    kept = np.random.default_rng(2).random(time.size) > 0.2
    kept[[0, -1]] = True
    lost = Trial(name=whole.name, table=whole.table[kept].reset_index(drop=True))
    filled = fill_gaps(lost, BASE)
    truth = 60 * np.sin(2 * np.pi * 0.5 * filled["time_s"])
    # Cubics through four readings on each side leave their noise, about once.
    assert np.abs(filled["base_angle_deg"] - truth).max() < 5 * BASE
    assert filled["time_s"].size >= time.size - 2


def test_a_long_gap_in_which_the_base_may_have_turned_is_kept_in_mind_until_it_turns_far():
    """The tip is behind by up to 10 deg; after the gap the base rests for 2 s, then turns by 90 deg."""
    time = np.arange(0, 12, 0.01)
    swing = np.interp(time, [0, 1, 2, 3, 4, 7, 8, 12], [0, 60, -60, 60, 0, 0, 90, 90])
    whole = trial(swing)
    table = whole.table.assign(tip_angle_deg=swing - 10.0)
    gapped = Trial(name=whole.name, table=table[(time <= 2.5) | (time >= 3.6)].reset_index(drop=True))
    filled = fill_gaps(gapped, BASE)
    at, tip = filled["time_s"], filled["tip_angle_deg"]
    # Twice 10 deg are turned back 0.33 s after the gap already, and a second is left out in any case.
    assert np.isnan(tip[(at > 2.5) & (at < 4.5)]).all()
    assert np.isfinite(tip[at > 4.8]).all()
