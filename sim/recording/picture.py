"""A recording as a picture: angles, torque, lengths, and the lag along the shaft."""

from pathlib import Path

import matplotlib as mpl
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes

from models.user_text import in_figure
from sim.files import writing
from sim.recording.recording import Recording

mpl.use("Agg")


def draw(recording: Recording, path: Path, *, force: bool = False) -> None:
    """Write a picture of a recording as PNG.

    Raises:
      OutputExists: the path exists and `force` is not given.
    """
    figure, axes = plt.subplots(3, 1, figsize=(9, 8), sharex=True, layout="constrained")
    time = recording["time_s"]
    axes[0].plot(time, recording["base_angle_deg"], color="0.4", label="base")
    axes[0].plot(time, recording["tip_angle_deg"], color="tab:red", label="tip")
    axes[0].set(ylabel="angle, deg", title=in_figure(_title(recording)))
    axes[1].plot(time, recording["base_torque_n_mm"], color="tab:blue", label="base torque")
    axes[1].set(ylabel="torque, N mm")
    axes[1].legend(loc="upper left")
    lengths = axes[1].twinx()
    lengths.plot(time, recording["inserted_mm"], color="tab:brown", lw=1, label="inserted, mm")
    lengths.set(ylabel="inserted, mm", ylim=(0, None))
    axes[0].legend(loc="upper left")
    _draw_lag(axes[2], recording)
    axes[2].set(xlabel="time, s")
    with writing(path, force=force) as part:
        figure.savefig(part, dpi=120, format="png")
    plt.close(figure)


def _title(recording: Recording) -> str:
    return str(recording.parameters.get("description") or recording.parameters.get("protocol") or "run")


def _draw_lag(axis: Axes, recording: Recording) -> None:
    angles = recording.group("shaft")
    if not angles.size:
        return
    lag = recording["base_angle_deg"][:, None] - angles
    limit = max(1.0, float(np.abs(lag).max()))
    nodes = np.array(recording.parameters["nodes_mm"])
    mesh = axis.pcolormesh(
        recording["time_s"], nodes, lag.T, cmap="RdBu_r", vmin=-limit, vmax=limit, shading="gouraud"
    )
    axis.set(ylabel="from the chuck at the start, mm")
    axis.figure.colorbar(mesh, ax=axis, label="lag behind the base, deg", location="bottom", shrink=0.6)
