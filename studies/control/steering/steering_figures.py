"""steered.png and planar.png."""

from collections.abc import Sequence
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patheffects import withStroke

from studies.control.steering.planar_study import PLANAR_CASES, WITHIN_MM, PlaneApproach
from studies.control.steering.steered_insertions import PUBLISHED_MM, SteeredInsertion, TurnOrder
from studies.control.steering.steering_study import SteeringStudy

_COLOURS = dict(zip(PLANAR_CASES, ("black", "tab:red", "tab:blue", "tab:green"), strict=True))
_LINES = dict(zip(PLANAR_CASES, ("-", "--", ":", "-."), strict=True))
_STYLES: dict[str, dict[str, Any]] = {
    "baseline_right": {"color": "0.6", "lw": 3},
    "baseline_left": {"color": "k", "ls": ":"},
    "base_only": {"color": "tab:blue", "ls": "-."},
    "feedforward": {"color": "tab:green", "lw": 5, "alpha": 0.45},  # least_time lies on it
    "least_time": {"color": "tab:red", "ls": "--"},
}
"""Told apart in grey, too."""
_SHOWN_MM = 5.0


def draw_steered(study: SteeringStudy) -> Figure:
    """Draw Figs. 11 and 12: paths from above, and height over the plane for both orders of turns."""
    figure, axes = plt.subplots(1, 3, figsize=(17, 5), layout="constrained")
    for one in study.steered[TurnOrder.TO_AND_FRO]:
        axes[0].plot(one.path_mm[:, 0], one.path_mm[:, 1], **_STYLES[one.name])
    axes[0].set(xlabel="x, mm", ylabel="y, mm", title="From above", aspect="equal")
    _draw_heights(axes[1], study.steered[TurnOrder.TO_AND_FRO], "Half turns to and fro, as in Fig. 12")
    for name, height in PUBLISHED_MM.items():
        axes[1].axhline(height, color="grey", lw=0.8, ls="--")
        axes[1].annotate(f"{name}, published", (2, height), va="bottom", fontsize=8, color="grey")
    _draw_heights(axes[2], study.steered[TurnOrder.WINDING], "Half turns in one sense")
    axes[2].sharey(axes[1])
    return figure


def _draw_heights(axis: Axes, insertions: list[SteeredInsertion], title: str) -> None:
    for one in insertions:
        x, _, z = one.path_mm.T
        axis.plot(x, z, label=f"{one.name}: {one.out_of_plane_mm:.2f} mm", **_STYLES[one.name])
    axis.set(xlabel="x, mm", ylabel="height over the plane, mm", title=title)
    axis.legend(fontsize=8)


def draw_planes(study: SteeringStudy) -> Figure:
    """Draw heights over the plane: above with known pose, below with images, each seed thin and the
    median of the seeds as a thick line."""
    count = len(study.known_pose)
    figure, axes = plt.subplots(
        2, count, figsize=(4.6 * count, 7.5), layout="constrained", squeeze=False, sharey=True
    )
    for axis, (speed, approaches) in zip(axes[0], study.known_pose.items(), strict=True):
        for one in approaches:
            axis.plot(one.travelled_mm, one.height_mm, lw=1.2, **_look(one.name))
        _shade_plane(axis)
        axis.set_title(f"pose known, {speed:g} mm/s")
    for axis, (speed, cases) in zip(axes[1], study.imaged.items(), strict=True):
        for name, approaches in cases.items():
            _draw_seeds(axis, name, approaches)
        _shade_plane(axis)
        axis.set(title=f"images of the height, {speed:g} mm/s", xlabel="travelled, mm")
    for row in axes:
        row[0].set(ylabel="height over the plane, mm", ylim=(-_SHOWN_MM, _SHOWN_MM))
    handles = [Line2D([], [], **_look(name)) for name in _COLOURS]
    figure.legend(handles, list(_COLOURS), loc="outside lower center", ncols=len(_COLOURS))
    return figure


def _draw_seeds(axis: Axes, name: str, approaches: Sequence[PlaneApproach]) -> None:
    for one in approaches:
        axis.plot(one.travelled_mm, one.height_mm, color=_COLOURS[name], lw=0.6, alpha=0.35)
    if approaches:
        median = np.median([one.height_mm for one in approaches], axis=0)
        (line,) = axis.plot(approaches[0].travelled_mm, median, lw=2, **_look(name))
        line.set(path_effects=[withStroke(linewidth=3.5, foreground="white")], zorder=3)


def _look(name: str) -> dict[str, Any]:
    return {"color": _COLOURS[name], "ls": _LINES[name]}


def _shade_plane(axis: Axes) -> None:
    axis.axhspan(-WITHIN_MM, WITHIN_MM, color="0.9", zorder=0)
