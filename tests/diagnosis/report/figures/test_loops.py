"""Loops of torque and lag."""

from dataclasses import replace

import numpy as np
import pytest

from diagnosis.log.trial import Trial
from diagnosis.report.figures.loops import describe_loops, draw_loops, telling_trials

NAMES = ["measured", "nominal", "explained"]


def without(found, column):
    """The diagnosis of a log whose trials lack a column."""
    trials = [Trial(name=t.name, table=t.table.drop(columns=column)) for t in found.log.trials]
    return replace(found, log=replace(found.log, trials=tuple(trials)))


def lines(axis):
    return {line.get_label(): line.get_xydata().T for line in axis.get_lines()}


def test_a_loop_shows_measured_nominal_and_explained_readings(dry):
    torque, lag = draw_loops(dry.found).axes[:2]
    first = telling_trials(dry.found)[0]
    trial, nominal = dry.log.trials[first], dry.found.nominal[first]
    assert list(lines(torque)) == list(lines(lag)) == NAMES
    base = trial["base_angle_deg"]
    # Trials of the fixture have fewer samples than a picture shows: every one is drawn.
    np.testing.assert_array_equal(lines(torque)["measured"], [base, trial["base_torque_n_mm"]])
    drawn = lines(lag)["nominal"]
    np.testing.assert_array_equal(drawn, [nominal.base_torque_n_mm, base - nominal.tip_angle_deg])


def test_the_explained_loop_is_nearer_to_the_measured_one(dry):
    for axis in draw_loops(dry.found).axes[::2]:
        torque = {name: own[1] for name, own in lines(axis).items()}
        left = [np.std(torque["measured"] - torque[name]) for name in NAMES[1:]]
        assert left[1] < left[0]


def test_words_say_how_far_each_loop_is_off(dry):
    said = describe_loops(dry.found)
    trial, i = dry.log.trials[1], 1
    assert i in telling_trials(dry.found)
    left = trial["base_torque_n_mm"] - dry.found.nominal[i]["base_torque_n_mm"]
    assert f"the nominal loop is off by {np.sqrt(np.mean(left**2)):.2g}, the explained one by " in said
    assert trial.name in said


def test_without_a_sensor_the_loop_of_the_other_is_left(dry):
    torque = draw_loops(without(dry.found, "tip_angle_deg")).axes
    assert [axis.get_ylabel() for axis in torque] == ["base torque, N mm"] * 3
    lag = draw_loops(without(dry.found, "base_torque_n_mm")).axes
    assert [axis.get_ylabel() for axis in lag] == ["lag (base − tip), deg"] * 3
    assert [axis.get_xlabel() for axis in lag] == ["base angle, deg"] * 3


def test_long_trials_are_decimated_to_means(dry):
    long = dry.log.trials[0].table
    long = type(long)({name: np.repeat(long[name].to_numpy(), 10) for name in long})
    trial = Trial(name="long", table=long.assign(time_s=0.001 * np.arange(len(long))))

    def tenfold(own):
        again = {s: np.repeat(own[s], 10) for s in ("tip_angle_deg", "base_torque_n_mm")}
        return [replace(own, **again)]

    told = replace(dry.found.assessment, explained=tenfold(dry.found.assessment.explained[0]))
    found = replace(
        dry.found,
        log=replace(dry.log, trials=(trial,)),
        nominal=tenfold(dry.found.nominal[0]),
        assessment=told,
    )
    drawn = lines(draw_loops(found).axes[0])["measured"]
    assert drawn.shape[1] <= 1500 < len(long)
    assert drawn[1].mean() == pytest.approx(trial["base_torque_n_mm"].mean(), abs=1e-3)


def test_trials_that_are_noise_alone_are_not_shown_first(dry):
    perfect = [dry.found.assessment.explained[0], *dry.found.nominal[1:]]
    copies = dry.log.trials * 2
    found = replace(
        dry.found,
        log=replace(dry.log, trials=copies),
        nominal=[*perfect, *dry.found.nominal],
    )
    assert 0 not in telling_trials(found)
    assert len(telling_trials(found)) == 3
