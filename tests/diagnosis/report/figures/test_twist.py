"""Angle along the shaft."""

import numpy as np

from diagnosis.replay.twist import ShaftTwist
from diagnosis.report.figures.twist import describe_twist, draw_twist

NODES = np.array([0.0, 50.0, 100.0])


def twist(**along):
    return ShaftTwist(
        trial="trial_02.csv",
        at_s=4.5,
        free_mm=40.0,
        inserted_mm=60.0,
        measured_tip_deg=71.0,
        along={name: np.stack([NODES, np.array(angles)]) for name, angles in along.items()},
    )


BOTH = twist(nominal=[90.0, 85.0, 80.0], explained=[90.0, 80.0, 70.0])


def test_nominal_explained_and_the_reading_of_the_tip_are_shown_and_what_was_added():
    angle, added = draw_twist(BOTH).axes
    labels = [line.get_label() for line in angle.get_lines()]
    assert labels == ["nominal", "explained", "tip, measured"]
    assert list(angle.get_lines()[2].get_xydata()[0]) == [100.0, 71.0]
    np.testing.assert_allclose(added.get_lines()[0].get_ydata(), [0.0, -5.0, -10.0])


def test_each_of_several_effects_has_a_line_of_its_own():
    several = twist(
        nominal=[90.0, 85.0, 80.0],
        tip_drag=[90.0, 83.0, 76.0],
        entry_friction=[90.0, 82.0, 77.0],
        explained=[90.0, 80.0, 70.0],
    )
    lines = draw_twist(several).axes[0].get_lines()[:4]
    assert [line.get_label() for line in lines[1:3]] == [
        "with tip_drag alone",
        "with entry_friction alone",
    ]
    assert len({str(line.get_linestyle()) for line in lines}) == 4


def test_four_effects_alone_differ_in_line_or_mark():
    names = ("a", "b", "c", "d")
    found = twist(nominal=[90.0, 85.0, 80.0], **{name: [90.0, 83.0, 76.0] for name in names})
    lines = draw_twist(found).axes[0].get_lines()[1:5]
    assert len({(line.get_linestyle(), line.get_marker()) for line in lines}) == 4


def test_what_comes_nearest_is_not_called_explained():
    legend = draw_twist(BOTH, "nearest").axes[0].get_legend()
    assert [text.get_text() for text in legend.get_texts()] == ["nominal", "nearest", "tip, measured"]
    assert "; nearest: 90.0 deg at the chuck" in describe_twist(BOTH, "nearest")


def test_meshes_that_differ_are_compared_at_the_same_places():
    found = ShaftTwist(
        trial="trial_01.csv",
        at_s=1.0,
        free_mm=40.0,
        inserted_mm=60.0,
        measured_tip_deg=None,
        along={
            "nominal": np.array([[0.0, 100.0], [90.0, 80.0]]),
            "explained": np.array([[0.0, 50.0, 100.0], [90.0, 84.0, 78.0]]),
        },
    )
    added = draw_twist(found).axes[1].get_lines()[0]
    np.testing.assert_allclose(added.get_ydata(), [0.0, -1.0, -2.0])
    assert "tip sensor" not in describe_twist(found)


def test_words_have_the_angles_at_both_ends():
    assert describe_twist(BOTH) == (
        "Angle along the shaft in trial_02.csv at 4.50 s. nominal: 90.0 deg at the chuck, 80.0 deg at "
        "the tip; explained: 90.0 deg at the chuck, 70.0 deg at the tip. The tip sensor read 71.0 deg."
    )
