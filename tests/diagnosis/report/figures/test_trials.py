"""A trial along time."""

from dataclasses import replace

import numpy as np
import pytest

from diagnosis.in_sigma import in_sigma
from diagnosis.log.trial import Trial
from diagnosis.report.figures.trials import describe_trial, draw_trial


def test_a_trial_shows_both_sensors_with_residuals_below(dry):
    found = dry.found
    above, _, below, _ = draw_trial(found, 0).axes
    torque = dry.log.trials[0]["base_torque_n_mm"]
    labels = {line.get_label(): line for line in above.get_lines()}
    assert set(labels) == {"measured", "nominal", "explained"}
    np.testing.assert_array_equal(labels["measured"].get_ydata(), torque)
    left = (torque - found.nominal[0]["base_torque_n_mm"]) / found.noise["base_torque_n_mm"]
    np.testing.assert_array_equal(below.get_lines()[0].get_ydata(), left)


def test_nominal_and_explained_differ_in_their_lines(dry):
    lines = {line.get_label(): line for line in draw_trial(dry.found, 0).axes[0].get_lines()}
    assert lines["nominal"].get_linestyle() == "--"
    assert lines["explained"].get_linestyle() == "-"


def test_residuals_have_means_that_differ_in_their_lines_too(dry):
    _, _, torque, tip = draw_trial(dry.found, 0).axes
    for below in (torque, tip):
        _, nominal, _, explained = below.get_lines()
        assert (nominal.get_linestyle(), explained.get_linestyle()) == ("--", "-")
        assert len(nominal.get_xdata()) <= 100
    left = dry.log.trials[0]["tip_angle_deg"] - dry.found.nominal[0]["tip_angle_deg"]
    means = tip.get_lines()[1].get_ydata()
    # Blocks are of one size, but for the last.
    assert np.mean(means) == pytest.approx(left.mean() / dry.found.noise["tip_angle_deg"], abs=0.1)


def test_words_name_the_trial_and_its_residuals(dry):
    said = describe_trial(dry.found, 1)
    assert said.startswith("trial_02.csv over 12 s")
    trial = dry.log.trials[1]
    left = (trial["tip_angle_deg"] - dry.found.nominal[1]["tip_angle_deg"]) / dry.found.noise[
        "tip_angle_deg"
    ]
    assert f"tip {in_sigma(np.sqrt(np.mean(left**2)))}, then " in said


def test_a_sensor_that_read_nothing_is_a_prediction_alone(dry):
    bare = [Trial(name=t.name, table=t.table.drop(columns="tip_angle_deg")) for t in dry.log.trials]
    alone = replace(dry.found, log=replace(dry.log, trials=tuple(bare)))
    axes = draw_trial(alone, 0).axes
    assert [len(axis.get_lines()) for axis in axes] == [3, 2, 4, 0]
    assert "tip" not in describe_trial(alone, 0)
