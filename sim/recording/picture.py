"""A recording as a picture: angles, torque, lengths, and the lag along the shaft."""

from pathlib import Path
from typing import Any

import matplotlib as mpl
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes

from models.user_text import in_figure
from sim.files import writing
from sim.recording.recording import Recording
from sim.recording.shaft_places import node_places_mm

mpl.use("Agg")

_ANGLES: dict[str, tuple[str, dict[str, Any]]] = {
    "base_angle_deg": ("base", {"color": "0.55", "lw": 2.5}),
    "wanted_tip_deg": ("tip, wanted", {"color": "tab:green", "ls": ":"}),
    "estimate_tip_deg": ("tip, estimated", {"color": "tab:orange", "ls": "-."}),
    "tip_angle_deg": ("tip", {"color": "tab:red", "ls": "--"}),
}
"""Told apart in grey, too."""
_LEVELS = (-0.75, -0.5, -0.25, 0.25, 0.5, 0.75)  # of the largest lag


def draw(recording: Recording, path: Path, *, force: bool = False) -> None:
    """Write a picture of a recording as PNG.

    Raises:
      OutputExists: the path exists and `force` is not given.
    """
    shape = recording.group("shaft").size > 0
    figure, axes = plt.subplots(
        4 if shape else 3,
        1,
        figsize=(9, 9) if shape else (9, 6),
        height_ratios=(3, 2, 1.2, 3.4)[: 4 if shape else 3],
        sharex=True,
        layout="constrained",
    )
    time = recording["time_s"]
    for name, (label, style) in _ANGLES.items():
        if name in recording.table:
            axes[0].plot(time, recording[name], label=label, **style)
    axes[0].set(ylabel="angle, deg", title=in_figure(_title(recording)))
    axes[0].legend(loc="upper left", bbox_to_anchor=(1.01, 1.0))  # beside the curves, over none
    axes[1].plot(time, recording["base_torque_n_mm"], color="tab:blue")
    axes[1].set(ylabel="base torque\nN mm")
    axes[2].plot(time, recording["inserted_mm"], color="tab:brown")
    axes[2].set(ylabel="inserted\nmm", ylim=(0, None))
    if shape:
        _draw_lag(axes[3], recording)
    axes[-1].set(xlabel="time, s")
    try:
        with writing(path, force=force) as part:
            figure.savefig(part, dpi=120, format="png")
    finally:
        plt.close(figure)


def _title(recording: Recording) -> str:
    return str(recording.parameters.get("description") or recording.parameters.get("protocol") or "run")


def _draw_lag(axis: Axes, recording: Recording) -> None:
    """Draw the lag along the shaft over time, with lines of equal lag, dashed if negative."""
    lag = recording["base_angle_deg"][:, None] - recording.group("shaft")
    limit = max(1.0, float(np.abs(lag).max()))
    places = node_places_mm(recording)
    time = np.broadcast_to(recording["time_s"][:, None], places.shape)
    mesh = axis.pcolormesh(
        time, places, lag, cmap="RdBu_r", vmin=-limit, vmax=limit, shading="gouraud", rasterized=True
    )
    levels = [part * limit for part in _LEVELS if lag.min() < part * limit < lag.max()]
    if levels:
        axis.contour(time, places, lag, levels=levels, colors="k", linewidths=0.6)
    axis.axhline(0.0, color="k", lw=1)
    axis.annotate("entry", (1.005, 0.0), xycoords=("axes fraction", "data"), va="center", fontsize=9)
    axis.set(ylabel="along the shaft\nmm from the entry")
    axis.invert_yaxis()
    bar = axis.figure.colorbar(mesh, ax=axis, location="bottom", shrink=0.6, aspect=40)
    bar.set_label("lag behind the base, deg (dashed lines: negative)")
