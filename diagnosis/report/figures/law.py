"""A free-form law as a curve with its 95 % band."""

import math
from textwrap import fill

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

from diagnosis.freeform.law_curve import Law
from diagnosis.freeform.missing.course import course_of
from diagnosis.freeform.missing.in_words import repeating
from diagnosis.freeform.missing.words import VARIABLES
from diagnosis.report.figures.layout import subplots
from diagnosis.report.figures.style import PREDICTIONS

Array = NDArray[np.float64]

_SIZE = (4.4, 3.0)  # inches: on a phone hardly smaller, so that its letters are read
_LETTERS = 60  # in a line of the title
_DRAWN_OVER = {"event": "time", "direction": "rate"}  # where a law of the first is a curve
_DIRECTIONS = {-1.0: "backwards", 0.0: "neither", 1.0: "forwards"}
_DECADES = 30.0  # between the lowest and the highest x of a logarithmic axis, at least


def draw_law(law: Law, period_deg: float = 0.0) -> Figure:
    """The curve; of a law that has a value in each direction, a bar for each.

    Args:
      period_deg: after which the law repeats itself; it is drawn over one period; 0: it does not.
    """
    figure, axis = subplots(figsize=_SIZE)
    x, y, below, above = _over_a_period(law, period_deg)
    off = np.abs(np.array([y - below, above - y]))
    colour = PREDICTIONS["explained"]
    if law.variable == "direction" and {*law.x} <= {*_DIRECTIONS}:
        axis.bar(x, y, width=0.8 * np.diff(x).min(), yerr=off, color=colour, alpha=0.6, capsize=6)
        axis.set_xticks(x, [_DIRECTIONS[one] for one in x])
        axis.axhline(0.0, color="k", lw=0.8)
    else:
        axis.fill_between(x, below, above, color=colour, alpha=0.2, lw=0, label="95 % band")
        axis.plot(x, y, color=colour, marker="o", ms=4, label="free-form law")
        axis.set_xlabel(_label(law, period_deg))
        axis.legend(fontsize=8)
        axis.locator_params(axis="x", nbins=6)
        if x[0] > 0 and x[-1] > _DECADES * x[0]:
            axis.set_xscale("log")
    axis.set_title(
        fill(f"{law.title}, {law.unit}".removesuffix(", -"), _LETTERS), loc="left", fontsize=9
    )
    axis.grid(alpha=0.3)
    return figure


def _over_a_period(law: Law, period_deg: float) -> Array:
    """x, y and both ends of the band, (4, K); a period ends as it begins."""
    points = np.array([law.x, law.y, law.low, law.high])
    first, last = points[0, 0], points[0, -1]
    if not period_deg or math.isclose(last - first, period_deg):
        return points
    return np.column_stack([points, points[:, 0] + [period_deg, 0.0, 0.0, 0.0]])


def _label(law: Law, period_deg: float) -> str:
    over = VARIABLES[_DRAWN_OVER.get(law.variable, law.variable)]
    variable = f"{over}, {law.x_unit}".removesuffix(", -")
    return f"{variable}\n(repeats every {period_deg:.4g} deg)" if period_deg else variable


def describe_law(law: Law, period_deg: float = 0.0) -> str:
    """The picture in words."""
    return f"Free-form law with its 95 % band: {course_of(law)}{repeating(period_deg)}."
