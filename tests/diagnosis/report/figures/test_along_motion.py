"""Residuals along the motion, in pictures."""

from dataclasses import replace

import numpy as np

from diagnosis.in_sigma import over_sigma
from diagnosis.log.trial import Trial
from diagnosis.report.figures.along_motion import describe_along_motion, draw_along_motion


def drawn(axis):
    """Lines with their labels, without the guides."""
    return [line for line in axis.get_lines() if line.get_marker() in "o><"]


def test_each_sensor_is_shown_against_angle_reversal_and_rate(dry):
    axes = draw_along_motion(dry.found).axes
    assert len(axes) == 6
    labels = [line.get_label() for line in drawn(axes[0])]
    assert labels == ["nominal, forward", "nominal, back", "explained, forward", "explained, back"]
    assert [len(drawn(axis)) for axis in axes] == [4, 2, 2] * 2


def test_after_a_reversal_the_root_mean_square_falls_to_the_floor(dry):
    nominal, explained = (line.get_ydata() for line in drawn(draw_along_motion(dry.found).axes[1]))
    assert np.max(nominal) > 2
    # Parts of 20 samples at least: 16 % each.
    np.testing.assert_allclose(explained, 1.0, atol=4 * 0.16)


def test_after_a_reversal_no_mark_is_at_the_edge(dry):
    axis = draw_along_motion(dry.found).axes[1]
    low, high = axis.get_ylim()
    assert low == 0.0
    assert high > 1.05 * max(1.0, *(max(line.get_ydata()) for line in drawn(axis)))


def test_dry_friction_that_the_nominal_model_lacks_has_the_sign_of_the_motion(dry):
    """Torque is too large forward and too small back, at the same angle."""
    forward, back = drawn(draw_along_motion(dry.found).axes[0])[:2]
    assert np.mean(forward.get_ydata()) > 1
    assert np.mean(back.get_ydata()) < -1


def test_words_say_where_the_residual_is_largest(dry):
    told = dry.found.assessment
    since, value = max(told.shape.since_reversal_s, key=lambda part: part[1])
    assert (
        f"after a reversal, at {since:.3g} s: {over_sigma(value)}, explained"
        in describe_along_motion(dry.found)
    )


def test_one_sensor_has_one_row(dry):
    trials = [Trial(name=t.name, table=t.table.drop(columns="tip_angle_deg")) for t in dry.log.trials]
    alone = replace(dry.found, log=replace(dry.log, trials=tuple(trials)))
    assert len(draw_along_motion(alone).axes) == 3
