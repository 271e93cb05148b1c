"""Ellipses of pairs of parameters."""

import numpy as np
from diagnosis_fixtures import fit_of

from diagnosis.assessment.uncertainty.joint_uncertainty import joint_uncertainty
from diagnosis.report.figures.joint import describe_joint, draw_joint, pairs_of

THREE = ("tip_drag", "torque_bias", "tip_angle_bias")
SPREAD = np.array([[1.0, 0.5, 0.0], [0.5, 1.0, 0.0], [0.0, 0.0, 4.0]]) * 1e-4


def joint(count=3):
    names = THREE[:count]
    return joint_uncertainty(fit_of(names), SPREAD[:count, :count], names)


def test_every_pair_has_an_ellipse_about_the_fit():
    axes = [axis for axis in draw_joint(joint()).axes if axis.get_visible()]
    assert len(axes) == 3
    for axis, (i, j) in zip(axes, pairs_of(joint()), strict=True):
        outline, fit = axis.get_lines()
        np.testing.assert_array_equal(outline.get_xydata().T, joint().ellipse(i, j))
        assert list(fit.get_xydata()[0]) == [joint().values[i], joint().values[j]]
    assert axes[0].get_title(loc="left") == "correlation +0.50"


def test_words_have_the_correlations():
    assert describe_joint(joint()).endswith(
        "Correlations: tip_drag.damping and torque_bias.bias +0.50; tip_drag.damping and "
        "tip_angle_bias.bias +0.00; torque_bias.bias and tip_angle_bias.bias +0.00."
    )


def test_one_parameter_has_no_pair():
    assert pairs_of(joint(1)) == []
