"""What the drift of a working sensor may be."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import scored
from drifting_logs import drifted, moved, off, searched, sliding

from diagnosis.criteria.selection import (
    DRIFT_ALIKE_SIGMA,
    DRIFT_OF_TIP_ALONE_SIGMA,
    DRIFT_ONE_COURSE_SIGMA,
    DRIFT_QUICKEST_SIGMA,
    DRIFT_RANGE_SIGMA,
)
from diagnosis.log.trial import SENSORS, TORQUE
from diagnosis.selection.stages.sensors import working_sensor as module
from diagnosis.selection.stages.sensors.working_sensor import (
    allowed_sigma,
    drifts,
    drifts_too_far,
    in_a_second_sigma,
    is_all_that_is_missing,
    is_off_zero,
    range_sigma,
    spread_sigma,
    what_is_likelier,
    what_it_follows,
    with_few_effects,
    zeros_apart,
)


@pytest.mark.parametrize("sensor", SENSORS)
def test_a_drift_is_one_of_its_sensor_and_has_the_range_of_its_line(sensor):
    """In sigma, of which a size is 1.5; the other sensor has none."""
    _, after = searched(drifted(2.5, sensor), sensor)
    (other,) = {*SENSORS} - {sensor}
    assert (drifts(after, sensor), drifts(after, other)) == (True, False)
    assert range_sigma(after, sensor) == pytest.approx(1.5 * 2.5, abs=1.0)
    assert range_sigma(after, other) == 0.0


@pytest.mark.parametrize(
    ("names", "alone"), [((), True), (("tip_angle_bias",), True), (("tip_drag",), False)]
)
def test_a_large_drift_of_the_tip_is_all_that_is_missing_but_for_its_offset(names, alone, monkeypatch):
    state = replace(searched(drifted(0.0))[1], candidates=(scored(names, 1.0),))
    monkeypatch.setattr(module, "spread_sigma", lambda *_: 1.1 * DRIFT_OF_TIP_ALONE_SIGMA)
    assert is_all_that_is_missing(state, "tip_angle_deg") is alone
    assert not is_all_that_is_missing(state, "base_torque_n_mm")
    monkeypatch.setattr(module, "spread_sigma", lambda *_: 0.9 * DRIFT_OF_TIP_ALONE_SIGMA)
    assert not is_all_that_is_missing(state, "tip_angle_deg")


def test_another_zero_in_each_trial_is_no_range_within_one_but_a_spread_over_all():
    sensor = "tip_angle_deg"
    _, after = searched(moved((6, 0, 0), (-2, 0, 0), (0, 0, 0), sensor=sensor), sensor)
    assert range_sigma(after, sensor) < DRIFT_OF_TIP_ALONE_SIGMA
    assert spread_sigma(after, sensor) == pytest.approx(8.0, abs=1.0)


@pytest.mark.parametrize("sensor", SENSORS)
def test_of_one_line_in_every_trial_less_is_allowed(sensor):
    _, apart = searched(moved((0, 0, 4), (0, 0, -4), sensor=sensor), sensor)
    _, alike = searched(moved((0, 0, 4), (0, 0, 4), sensor=sensor), sensor)
    assert allowed_sigma(apart, sensor) == DRIFT_RANGE_SIGMA
    assert allowed_sigma(alike, sensor) == DRIFT_ALIKE_SIGMA


def test_lines_that_are_one_course_are_allowed_as_much_as_of_one_rate(monkeypatch):
    _, lines = searched(moved((0, 0, 4), (0, 0, 6), sensor=TORQUE), TORQUE)
    monkeypatch.setattr(module, "drifts_alike", lambda *_: False)
    assert allowed_sigma(lines, TORQUE) == DRIFT_ALIKE_SIGMA
    monkeypatch.setattr(module, "drifts_along_lines", lambda *_: False)
    assert allowed_sigma(lines, TORQUE) == DRIFT_ONE_COURSE_SIGMA


@pytest.mark.parametrize("sensor", SENSORS)
@pytest.mark.parametrize(
    ("begins", "rises", "apart"),
    [((9, 0), (0, 0), True), ((9, 0), (1, 1), True), ((9, 0), (5, 5), False), ((4, 0), (0, 0), False)],
    ids=["jumps", "hardly drifts", "drifts as far", "little"],
)
def test_zeros_that_jump_between_trials_are_no_drift(begins, rises, apart, sensor):
    each = ((zero, 0, rise) for zero, rise in zip(begins, rises, strict=True))
    _, after = searched(moved(*each, sensor=sensor), sensor)
    assert zeros_apart(after, sensor) is apart
    assert is_all_that_is_missing(after, sensor) is (apart if sensor == TORQUE else True)


@pytest.mark.parametrize("sensor", SENSORS)
def test_where_every_trial_is_off_zero_is_told(sensor):
    _, zeroed = searched(moved((0, 0, 4), (3, 0, 3), sensor=sensor), sensor)
    _, raised = searched(moved((3, 0, 3), (4, 0, 3), sensor=sensor), sensor)
    assert (is_off_zero(zeroed, sensor), is_off_zero(raised, sensor)) == (False, True)


@pytest.mark.parametrize(
    ("starts", "means", "off"),
    [
        ([2.5, 4.0, 5.0, 4.5, 5.5, 4.2], [0.0] * 6, True),
        ([2.5, -4.0, 5.0, -4.5, 5.5, -4.2], [3.0, -3.1, 2.9, -3.0, 3.2, -2.8], False),
        ([2.5, -4.0, 5.0, -4.5, 5.5, -4.2], [3.0, 3.1, 2.9, 3.0, 3.2, 2.8], True),
        ([0.1, 5.0], [3.0, 3.1], False),
        ([4.0, -5.0], [0.0, 0.0], True),
        ([4.0, 5.0, 30.0], [0.0] * 3, True),
        ([4.0, -5.0, -6.0], [0.0] * 3, False),
        ([], [], False),
    ],
    ids=[
        "on average",
        "either way",
        "in the means",
        "two trials",
        "every one",
        "to one side",
        "to both sides",
        "no drift",
    ],
)
def test_trials_are_off_zero_on_average_as_well(starts, means, off, monkeypatch):
    state = searched(drifted(0.0))[1]
    monkeypatch.setattr(module, "starts", lambda *_: np.array(starts))
    monkeypatch.setattr(module, "means_sigma", lambda *_: np.array(means))
    assert is_off_zero(state, "base_torque_n_mm") is off


def test_effects_that_do_not_count_stand_beside_a_drift_as_well():
    state = searched(drifted(0.0))[1]
    sets = (("tip_drag",), ("tip_drag", "tip_angle_bias"), ("tip_drag", "stiction"))
    state = replace(state, candidates=tuple(scored(names, 1.0) for names in sets))

    def few(sensor, beside=()):
        return [c.names for c in with_few_effects(state, sensor, beside).candidates]

    assert few("tip_angle_deg") == [*sets[:1]]
    assert few("tip_angle_deg", ["tip_angle_bias"]) == [*sets[:2]]
    assert few("base_torque_n_mm") == [*sets[:2]]  # the offset is one of the other sensor


@pytest.mark.parametrize("sensor", SENSORS)
def test_what_follows_the_axial_speed_beside_its_drift_is_told(sensor):
    """By a size of half, beside a drift of two."""
    log = sliding()
    speed = log.trials[0].table["speed_mm_s"].to_numpy()
    _, line = searched(off(log, sensor, lambda share: 2.0 * share), sensor)
    assert what_it_follows(line, sensor) == ""
    _, both = searched(off(log, sensor, lambda share: 2.0 * share + 0.5 * speed), sensor)
    assert drifts(both, sensor)
    assert what_it_follows(both, sensor) == "axial speed"


@pytest.mark.parametrize("sensor", SENSORS)
def test_a_small_law_is_likelier_than_a_drift_that_takes_it_over(sensor):
    log = sliding()
    speed = log.trials[0].table["speed_mm_s"].to_numpy()
    before, after = searched(off(log, sensor, lambda _: 0.5 * speed), sensor)
    assert what_is_likelier(before, after, sensor) == "axial speed"
    before, after = searched(off(log, sensor, lambda share: 2.0 * share), sensor)
    assert what_is_likelier(before, after, sensor) == ""


@pytest.mark.parametrize("sensor", SENSORS)
def test_what_moves_fast_is_no_drift_however_little_it_moves_in_all(sensor, monkeypatch):
    """A line of 14 s is slow; as much within a second is none of a sensor that works."""
    _, after = searched(drifted(3.5, sensor), sensor)
    # 0.4 of the line, and what noise leaves of its estimate: 0.3 at either end.
    assert in_a_second_sigma(after, sensor) < 1.5
    assert drifts_too_far(after, sensor) == ""
    monkeypatch.setattr(module, "in_a_second_sigma", lambda *_: 1.01 * DRIFT_QUICKEST_SIGMA)
    assert "within a second" in drifts_too_far(after, sensor)
    monkeypatch.setattr(module, "range_sigma", lambda *_: 1.01 * DRIFT_RANGE_SIGMA)
    assert "within a trial" in drifts_too_far(after, sensor)
