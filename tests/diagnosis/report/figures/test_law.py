"""A free-form law as a curve with its band."""

from dataclasses import replace

import numpy as np
import pytest
from free_forms import LAW

from diagnosis.report.figures.law import describe_law, draw_law

WAYS = replace(
    LAW, variable="direction", x=(-1.0, 1.0), y=(0.1, 0.2), low=(0.08, 0.17), high=(0.12, 0.21)
)


def test_the_curve_and_its_band_are_those_of_the_law():
    axis = draw_law(LAW).axes[0]
    (line,) = axis.lines
    np.testing.assert_allclose(line.get_xydata(), np.transpose([LAW.x, LAW.y]))
    (band,) = axis.collections
    outline = band.get_paths()[0].vertices[:, 1]
    assert (outline.min(), outline.max()) == pytest.approx((min(LAW.low), max(LAW.high)))
    labels = [text.get_text() for text in axis.get_legend().get_texts()]
    assert labels == ["95 % band", "free-form law"]


def test_axes_say_what_and_in_which_unit():
    axis = draw_law(LAW).axes[0]
    assert axis.get_xlabel() == "the rate of turning, rad/s"
    assert axis.get_title("left") == "friction along the shaft, N mm / mm"
    bare = draw_law(replace(LAW, unit="-", x_unit="-")).axes[0]
    bare_labels = (bare.get_xlabel(), bare.get_title("left"))
    assert bare_labels == ("the rate of turning", "friction along the shaft")


@pytest.mark.parametrize(
    ("variable", "unit", "label"),
    [("event", "s", "the time, s"), ("direction", "rad/s", "the rate of turning, rad/s")],
)
def test_a_curve_of_an_event_or_a_direction_says_what_it_is_drawn_over(variable, unit, label):
    axis = draw_law(replace(LAW, variable=variable, x_unit=unit)).axes[0]
    assert axis.get_xlabel() == label
    np.testing.assert_allclose(axis.lines[0].get_xydata(), np.transpose([LAW.x, LAW.y]))


def test_a_long_title_has_several_lines():
    axis = draw_law(replace(LAW, title="friction along the shaft " * 4)).axes[0]
    assert max(map(len, axis.get_title("left").splitlines())) <= 60


@pytest.mark.parametrize(
    ("x", "scale"),
    [((0.01, 0.1, 1.0), "log"), ((0.1, 0.5, 1.0), "linear"), ((-0.01, 0.5, 1.0), "linear")],
)
def test_what_spans_decades_is_drawn_over_its_logarithm(x, scale):
    assert draw_law(replace(LAW, x=x)).axes[0].get_xscale() == scale


BETWEEN = replace(
    WAYS, x=(-1.0, 0.0, 1.0), y=(-5.0, -2.0, 1.5), low=(-5.2, -2.1, 1.4), high=(-4.9, -1.8, 1.7)
)
"""Of a bearing that has not yet slid either way."""


@pytest.mark.parametrize(
    ("law", "names"),
    [(WAYS, ["backwards", "forwards"]), (BETWEEN, ["backwards", "neither", "forwards"])],
)
def test_a_law_of_directions_is_a_bar_for_each_with_its_interval(law, names):
    axis = draw_law(law).axes[0]
    assert [bar.get_height() for bar in axis.patches] == list(law.y)
    assert [label.get_text() for label in axis.get_xticklabels()] == names
    ends = np.array([segment[:, 1] for segment in axis.collections[0].get_segments()])
    np.testing.assert_allclose(ends, np.transpose([law.low, law.high]))


def test_a_law_that_repeats_is_drawn_over_one_period_and_says_so():
    wave = replace(LAW, variable="tip_angle", x=(0.0, 40.0, 80.0), x_unit="deg")
    axis = draw_law(wave, 120.0).axes[0]
    np.testing.assert_allclose(axis.lines[0].get_xydata()[[0, -1]], [[0.0, 0.001], [120.0, 0.001]])
    assert axis.get_xlabel() == "the angle of the tip, deg\n(repeats every 120 deg)"
    assert describe_law(wave, 120.0).endswith(", and repeats every 120 deg.")


def test_a_period_that_is_whole_is_drawn_as_it_is():
    turn = replace(LAW, variable="tip_angle", x=(-180.0, 0.0, 180.0), x_unit="deg")
    (line,) = draw_law(turn, 360.0).axes[0].lines
    np.testing.assert_allclose(line.get_xdata(), turn.x)


def test_the_picture_is_told_in_words():
    said = describe_law(WAYS)
    assert said == (
        "Free-form law with its 95 % band: friction along the shaft is 2 times as strong forwards."
    )
