"""Rate, phases and reversals of the base."""

import numpy as np
from diagnosis_fixtures import trial, turns

from diagnosis.residuals.motion import base_rate, direction, phases, since_reversal


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


def test_a_direction_lasts_until_the_base_turns_the_other_way():
    one = trial(turns())
    time, way = one["time_s"], direction(one)
    assert (way[time < 0.8] == 0).all()
    assert (way[(time > 1.2) & (time < 4.8)] == 1).all()
    assert (way[time > 5.2] == -1).all()


def test_time_runs_from_the_reversal():
    one = trial(turns())
    time, since = one["time_s"], since_reversal(one)
    assert np.isinf(since[time < 4.8]).all()
    # The turn back begins at 5 s; its rate is seen up to the 0.2 s of its average earlier.
    np.testing.assert_allclose(since[time > 5.2], time[time > 5.2] - 5.0, atol=0.2)
    np.testing.assert_allclose(np.diff(since[time > 5.2]), 0.01)


def test_a_base_that_turns_one_way_never_reverses():
    one = trial(np.linspace(0, 90, 500))
    assert np.isinf(since_reversal(one)).all()
    assert not phases(one)["reversal"].any()
