"""Runs that a rig can do, as its log shows."""

import numpy as np
import pytest
from diagnosis_fixtures import RIG, prepared, trial, turns

from diagnosis.assessment.experiments import SAMPLE_S, experiments
from diagnosis.prepare.prepared_log import PreparedLog


def runs(*trials):
    return list(experiments(PreparedLog(rig=RIG, trials=tuple(prepared(t) for t in trials))))


def test_a_log_that_never_slides_asks_whether_the_rig_can():
    found = runs(trial(turns()))
    sliding = [e for e in found if "sliding out" in e.words]
    assert len(sliding) == len(found) / 2
    assert all("sliding out at 1 mm/s, if the rig can" in e.words for e in sliding)
    assert all(np.all(e.trial.speed_mm_s == -1.0) for e in sliding)


def test_a_log_that_slides_proposes_its_own_speed():
    found = runs(trial(turns(), speed=-2.5))
    assert any("sliding out at 2.5 mm/s" in e.words for e in found)
    assert not any("if the rig can" in e.words for e in found)


def test_depth_free_length_and_rate_are_those_of_the_log():
    for one in runs(trial(turns())):
        assert np.all(one.trial.inserted_mm == 90.0)
        assert "90 mm deep with 60 mm free" in one.words
        rates = np.abs(np.diff(one.trial.base_motion_deg)) / SAMPLE_S
        assert rates.max() < 1.2 * 150  # of the fast turn: 90 deg in 0.6 s


def test_free_length_grows_as_the_shaft_slides_out():
    sliding = [e.trial for e in runs(trial(turns(), speed=-2.5)) if "sliding" in e.words]
    for one in sliding:
        np.testing.assert_allclose(np.gradient(one.free_mm, one.time_s), -one.speed_mm_s)


def test_two_depths_are_tried_where_the_log_has_two():
    deep = trial(turns())
    deep.table["inserted_mm"] = 140.0
    assert len(runs(trial(turns()), deep)) == 2 * len(runs(trial(turns())))


def test_a_run_has_no_readings():
    one = runs(trial(turns()))[0].trial
    assert one.readings == {}
    assert not one.logged.any()
    assert one.sample_s == pytest.approx(SAMPLE_S)
