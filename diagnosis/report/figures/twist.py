"""How far each place of the shaft has turned, at the moment when the nominal model is off most."""

from itertools import cycle
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

from diagnosis.replay.twist import ShaftTwist
from diagnosis.report.figures.layout import subplots
from diagnosis.report.figures.style import LINES, MEASURED, PREDICTIONS, WIDE

Array = NDArray[np.float64]

_ALONE = ((":", ""), ("-.", ""), (":", "s"), ("-.", "^"))
"""Lines and marks of single effects, where there are several."""


def draw_twist(twist: ShaftTwist, best: str = "explained") -> Figure:
    """Angle along the shaft, and what each rig adds to the nominal one.

    Args:
      best: what the explanation is called.
    """
    figure, (angle, added) = subplots(1, 2, figsize=(WIDE, 3.4))
    alone = [name for name in twist.along if name not in PREDICTIONS]
    looks: dict[str, dict[str, Any]] = {
        name: {"color": c, "ls": LINES[name], "lw": 1.6} for name, c in PREDICTIONS.items()
    }
    for name, (line, mark) in zip(alone, cycle(_ALONE), strict=False):
        looks[name] = {"color": "0.35", "ls": line, "marker": mark, "ms": 4, "markevery": 0.2, "lw": 1.3}
    called = {name: f"with {name} alone" for name in alone} | {"nominal": "nominal", "explained": best}
    for name, (place, turned) in twist.along.items():
        angle.plot(place, turned, label=called[name], **looks[name])
        if name != "nominal":
            added.plot(
                place, turned - at_places(twist, "nominal", place), label=called[name], **looks[name]
            )
    if twist.measured_tip_deg is not None:
        end = twist.free_mm + twist.inserted_mm
        angle.plot([end], [twist.measured_tip_deg], "o", color=MEASURED, mec="k", label="tip, measured")
    for axis in (angle, added):
        axis.axvspan(twist.free_mm, twist.free_mm + twist.inserted_mm, color="0.92", zorder=0)
        axis.set(xlabel="distance from the chuck, mm; grey: in the tissue")
        axis.legend(fontsize=8)
    added.axhline(0, color="k", lw=0.8)
    angle.set(ylabel="angle of the shaft, deg")
    angle.set_title(f"{twist.trial}, {twist.at_s:.2f} s", fontsize=10, loc="left")
    added.set(ylabel="more than nominal, deg")
    added.set_title("what the effects change", fontsize=10, loc="left")
    return figure


def describe_twist(twist: ShaftTwist, best: str = "explained") -> str:
    """The picture in words."""
    called = {"explained": best}
    told = "; ".join(
        f"{called.get(name, name)}: {turned[0]:.1f} deg at the chuck, {turned[-1]:.1f} deg at the tip"
        for name, (_, turned) in twist.along.items()
    )
    tip = twist.measured_tip_deg
    read = "" if tip is None else f" The tip sensor read {tip:.1f} deg."
    return f"Angle along the shaft in {twist.trial} at {twist.at_s:.2f} s. {told}.{read}"


def at_places(twist: ShaftTwist, name: str, place: Array) -> Array:
    """Angle of one rig at distances from the chuck; meshes may differ."""
    return np.interp(place, *twist.along[name])
