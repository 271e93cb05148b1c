"""A free-form law as a curve with its 95 % band."""

from textwrap import fill

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.figure import Figure

from diagnosis.freeform.in_words import VARIABLES, course_of
from diagnosis.freeform.missing import Law
from diagnosis.report.figures.style import PREDICTIONS

_SIZE = (4.4, 3.0)  # inches: on a phone hardly smaller, so that its letters are read
_LETTERS = 60  # in a line of the title
_DECADES = 30.0  # between the lowest and the highest x of a logarithmic axis, at least


def draw_law(law: Law) -> Figure:
    """The curve; of a law of two directions, a bar for each."""
    figure, axis = plt.subplots(figsize=_SIZE, layout="constrained")
    x, y = np.array(law.x), np.array(law.y)
    off = np.abs(np.array([y - law.low, law.high - y]))
    colour = PREDICTIONS["explained"]
    if law.variable == "direction":
        axis.bar(["backwards", "forwards"], y, yerr=off, color=colour, alpha=0.6, capsize=6)
        axis.axhline(0.0, color="k", lw=0.8)
    else:
        axis.fill_between(x, law.low, law.high, color=colour, alpha=0.2, lw=0, label="95 % band")
        axis.plot(x, y, color=colour, marker="o", ms=4, label="free-form law")
        axis.set_xlabel(f"{VARIABLES[law.variable]}, {law.x_unit}".removesuffix(", -"))
        axis.legend(fontsize=8)
        if x[0] > 0 and x[-1] > _DECADES * x[0]:
            axis.set_xscale("log")
    axis.set_title(
        fill(f"{law.title}, {law.unit}".removesuffix(", -"), _LETTERS), loc="left", fontsize=9
    )
    axis.grid(alpha=0.3)
    return figure


def describe_law(law: Law) -> str:
    """The picture in words."""
    return f"Free-form law with its 95 % band: {course_of(law)}."
