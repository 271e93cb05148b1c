"""Pairs of parameters with the ellipse in which both are at once."""

from itertools import combinations

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from diagnosis.assessment.uncertainty.joint_uncertainty import JointUncertainty
from diagnosis.report.figures.layout import subplots
from diagnosis.report.figures.style import PREDICTIONS

_PAIRS = 6
_COLUMNS = 3


def pairs_of(joint: JointUncertainty) -> list[tuple[int, int]]:
    """Pairs that are drawn: those with a parameter of an effect first."""
    return list(combinations(range(len(joint.names)), 2))[:_PAIRS]


def draw_joint(joint: JointUncertainty) -> Figure:
    """An ellipse for each pair; there is one pair at least."""
    pairs = pairs_of(joint)
    columns = min(_COLUMNS, len(pairs))
    rows = -(-len(pairs) // columns)
    figure, axes = subplots(rows, columns, figsize=(3.7 * columns, 3.1 * rows), squeeze=False)
    for axis, (i, j) in zip(axes.flat, pairs, strict=False):
        _draw_pair(axis, joint, i, j)
    for axis in list(axes.flat)[len(pairs) :]:
        axis.set_visible(False)
    return figure


def describe_joint(joint: JointUncertainty) -> str:
    """The picture in words."""
    told = "; ".join(
        f"{joint.names[i]} and {joint.names[j]} {joint.correlation(i, j):+.2f}"
        for i, j in pairs_of(joint)
    )
    return f"95 % ellipses of pairs of parameters. Correlations: {told}."


def _draw_pair(axis: Axes, joint: JointUncertainty, i: int, j: int) -> None:
    across, up = joint.ellipse(i, j)
    axis.fill(across, up, color=PREDICTIONS["explained"], alpha=0.2, lw=0)
    axis.plot(across, up, color=PREDICTIONS["explained"], lw=1.5)
    axis.plot(joint.values[i], joint.values[j], "+", color="k", ms=9)
    axis.set_title(f"correlation {joint.correlation(i, j):+.2f}", fontsize=10, loc="left")
    axis.set_xlabel(_label(joint, i), fontsize=9)
    axis.set_ylabel(_label(joint, j), fontsize=9)
    axis.tick_params(labelsize=8)
    axis.locator_params(axis="x", nbins=4)
    axis.ticklabel_format(useOffset=False)


def _label(joint: JointUncertainty, i: int) -> str:
    unit = joint.parameters[i].unit
    return f"{joint.owners[i]}\n{joint.parameters[i].name}" + (f", {unit}" if unit != "-" else "")
