"""Runs that a rig can do, as its log shows."""

import numpy as np
import pytest
from diagnosis_fixtures import RIG, prepared, trial, turns

from diagnosis.assessment.advice.experiments import (
    SAMPLE_S,
    experiments,
    has_axis,
    sliding_experiments,
)
from diagnosis.prepare.prepared_log import PreparedLog


def runs(*trials):
    return list(experiments(PreparedLog(rig=RIG, trials=tuple(prepared(t) for t in trials))))


def two_depths():
    deep = trial(turns())
    deep.table["inserted_mm"] = 140.0
    return trial(turns()), deep


def test_a_log_that_never_slides_asks_whether_the_rig_can():
    found = runs(*two_depths())
    sliding = [e for e in found if "sliding out" in e.words]
    assert len(sliding) == len(found) / 2
    assert all("sliding out at 1 mm/s, if the rig can" in e.words for e in sliding)
    assert all(np.all(e.trial.speed_mm_s == -1.0) for e in sliding)


def test_a_rig_without_an_axis_varies_rates_amplitudes_reversals_and_rests_alone():
    found = runs(trial(turns()), trial(turns(), name="trial_02.csv"))
    words = " ".join(e.words for e in found)
    assert "deep" not in words
    assert "sliding" not in words
    assert all(
        said in words for said in ("rest for 20 s", "reverse every 10 deg", "5 deg/s", "90 deg at 0.2")
    )
    for one in found:
        assert np.all(one.trial.inserted_mm == 90.0)
        assert np.all(one.trial.speed_mm_s == 0.0)


def test_what_only_sliding_tells_is_proposed_at_the_depth_that_the_rig_has():
    found = list(sliding_experiments(PreparedLog(rig=RIG, trials=(prepared(trial(turns())),))))
    assert found
    for one in found:
        assert "sliding out at 1 mm/s" in one.words
        assert "deep" not in one.words
        assert np.all(one.trial.inserted_mm == 90.0)
        assert np.all(one.trial.speed_mm_s == -1.0)


@pytest.mark.parametrize("way", ["slides", "two depths", "goes deeper"])
def test_a_rig_that_moves_the_needle_along_has_an_axis(way):
    deeper = trial(turns())
    deeper.table["inserted_mm"] = np.linspace(90, 95, len(deeper.table))
    logs = {"slides": [trial(turns(), speed=-0.5)], "two depths": two_depths(), "goes deeper": [deeper]}
    assert has_axis(PreparedLog(rig=RIG, trials=tuple(prepared(t) for t in logs[way])))


def test_the_reading_of_a_stage_that_stands_is_no_axis():
    stands = trial(turns())
    rng = np.random.default_rng(1)
    stands.table["inserted_mm"] += rng.uniform(-0.1, 0.1, len(stands.table))
    stands.table["speed_mm_s"] += rng.uniform(-0.01, 0.01, len(stands.table))
    assert not has_axis(PreparedLog(rig=RIG, trials=(prepared(stands),)))


def test_reversals_without_a_rest_turn_between_0_and_their_angle():
    one = next(e for e in runs(trial(turns())) if e.words.startswith("reverse every 10 deg"))
    assert one.trial.base_motion_deg.min() == pytest.approx(0.0, abs=1e-9)
    # 9.5 s at 10 deg/s: corners lie between samples by up to half of 0.04 s.
    assert one.trial.base_motion_deg.max() == pytest.approx(10.0, abs=0.21)
    assert np.abs(np.diff(one.trial.base_motion_deg)).max() == pytest.approx(10.0 * SAMPLE_S)


def test_a_log_that_slides_proposes_its_own_speed():
    found = runs(trial(turns(), speed=-2.5))
    assert any("sliding out at 2.5 mm/s" in e.words for e in found)
    assert not any("if the rig can" in e.words for e in found)


def test_depth_free_length_and_rate_are_those_of_the_log():
    for one in runs(trial(turns(), speed=-2.5)):
        assert np.all(one.trial.inserted_mm == 90.0)
        assert "90 mm deep with 75 mm free" in one.words
        rates = np.abs(np.diff(one.trial.base_motion_deg)) / SAMPLE_S
        assert rates.max() < 1.2 * 150  # of the fast turn: 90 deg in 0.6 s


def test_free_length_grows_as_the_shaft_slides_out():
    sliding = [e.trial for e in runs(trial(turns(), speed=-2.5)) if "sliding" in e.words]
    for one in sliding:
        np.testing.assert_allclose(np.gradient(one.free_mm, one.time_s), -one.speed_mm_s)


def test_two_depths_are_tried_where_the_log_has_two():
    assert len(runs(*two_depths())) == 2 * len(runs(trial(turns(), speed=-2.5)))


def test_a_run_has_no_readings():
    one = runs(trial(turns()))[0].trial
    assert one.readings == {}
    assert not one.logged.any()
    assert one.sample_s == pytest.approx(SAMPLE_S)
