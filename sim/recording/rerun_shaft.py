"""The needle of a recording in 3-D, and bars along the shaft, in rerun.

Output only: nothing that computes imports this module.
"""

from typing import Any

import numpy as np
import rerun as rr
from matplotlib import colormaps

from models import units
from sim.kernel.mesh import XI_LEFT, XI_RIGHT
from sim.recording.recording import Recording
from sim.recording.rerun_series import TIMELINE, Array, time_column
from sim.recording.shaft_places import node_places_mm

_FRAMES_PER_S = 20  # of the 3-D needle; the plots show every sample
_PATH_FRAMES = 400
# The twist is shown by arrows across the shaft, longer than the shaft is thick.
_ARROW_MM, _ARROW_RADIUS_MM, _SHAFT_RADIUS_MM = 9.0, 0.5, 0.6


def log_path(stream: rr.RecordingStream, recording: Recording) -> None:
    """Log the path of a steered tip, and the position of the tip on it."""
    names = ("path_x_mm", "path_y_mm", "path_z_mm")
    if not all(name in recording.table for name in names):
        return
    path = np.stack([recording[name] for name in names], axis=-1)
    stream.log("world/path", rr.LineStrips3D([path], radii=0.4, colors=[[214, 39, 40]]), static=True)
    every = np.unique(np.linspace(0, len(path) - 1, _PATH_FRAMES).astype(int))
    stream.send_columns(
        "world/tip",
        indexes=[time_column(recording["time_s"][every])],
        columns=rr.Points3D.columns(positions=path[every], radii=np.full(every.size, 1.5)),
    )


def log_shaft(stream: rr.RecordingStream, recording: Recording) -> None:
    """Log the shaft, arrows for its twist, coloured by lag, bars along it, and the tissue as a box."""
    angles = recording.group("shaft")
    if not angles.size:
        return
    time = recording["time_s"]
    frames = np.unique(np.searchsorted(time, np.arange(time[0], time[-1], 1 / _FRAMES_PER_S)))
    frames = np.unique(np.append(frames[frames < time.size], time.size - 1))
    lag = angles - recording["base_angle_deg"][:, None]
    scale = max(1.0, float(np.abs(lag).max()))
    colours = (colormaps["turbo"](0.1 + 0.85 * np.abs(lag[frames]) / scale)[..., :3] * 255).astype(
        np.uint8
    )
    stamps = time_column(time[frames])
    places = node_places_mm(recording)[frames]
    turn = angles[frames] * units.DEG
    across = _ARROW_MM * np.stack([np.zeros_like(turn), np.cos(turn), np.sin(turn)], axis=-1)
    axis = np.stack([places, np.zeros_like(places), np.zeros_like(places)], axis=-1)
    nodes = axis.shape[1]
    stream.send_columns(
        "world/bevel",
        indexes=[stamps],
        columns=rr.Arrows3D.columns(
            origins=axis.reshape(-1, 3),
            vectors=across.reshape(-1, 3),
            colors=colours.reshape(-1, 3),
            radii=np.full(frames.size * nodes, _ARROW_RADIUS_MM),
        ).partition(np.full(frames.size, nodes)),
    )
    stream.send_columns(
        "world/shaft",
        indexes=[stamps],
        columns=rr.LineStrips3D.columns(strips=list(axis), radii=np.full(frames.size, _SHAFT_RADIUS_MM)),
    )
    _log_profiles(stream, "shaft", time[frames], places, lag[frames])
    twist = recording.group("tissue")
    if twist.size:
        _log_profiles(stream, "tissue", time[frames], _site_places_mm(places), twist[frames])
    _log_tissue_box(stream, recording, frames, stamps)


def _log_profiles(
    stream: rr.RecordingStream, name: str, time_s: Array, places_mm: Array, values: Array
) -> None:
    """Log bars at their places along the shaft; the viewer takes one frame of bars at a time.

    Args:
      time_s: (frames,).
      places_mm, values: (frames, bars).
    """
    stamps = np.round(time_s * 1e9).astype("timedelta64[ns]")
    widths_mm = _bar_widths_mm(places_mm)
    each = zip(stamps, places_mm, widths_mm, values.astype(np.float32), strict=True)
    for stamp, at_mm, width_mm, heights in each:
        stream.set_time(TIMELINE, duration=stamp)
        stream.log(f"profile/{name}", rr.BarChart(heights, abscissa=at_mm, widths=width_mm))
    stream.reset_time()


def _bar_widths_mm(places_mm: Array) -> Array:
    """Widths of bars that do not overlap: the distance to the nearer neighbour."""
    steps = np.diff(places_mm, axis=1)
    if steps.shape[1] < 2:
        return np.repeat(steps, 2, axis=1)
    inner = np.minimum(steps[:, :-1], steps[:, 1:])
    return np.pad(inner, ((0, 0), (1, 1)), "edge")


def _site_places_mm(nodes_mm: Array) -> Array:
    """Places of the two contact sites of every element, (frames, 2 elements)."""
    first, length = nodes_mm[:, :-1], np.diff(nodes_mm, axis=1)
    sites = np.stack([first + XI_LEFT * length, first + XI_RIGHT * length], axis=-1)
    return sites.reshape(len(nodes_mm), -1)


def _log_tissue_box(stream: rr.RecordingStream, recording: Recording, frames: Any, stamps: Any) -> None:
    depth = np.maximum(recording["inserted_mm"], 0.1)[frames]
    half = np.stack([0.5 * depth, np.full(depth.size, 12.0), np.full(depth.size, 12.0)], axis=-1)
    centre = np.stack([0.5 * depth, np.zeros(depth.size), np.zeros(depth.size)], axis=-1)
    stream.log(
        "world/tissue",
        rr.Boxes3D.from_fields(colors=[[214, 160, 140]], fill_mode="majorwireframe"),
        static=True,
    )
    stream.send_columns(
        "world/tissue",
        indexes=[stamps],
        columns=rr.Boxes3D.columns(half_sizes=half, centers=centre),
    )
