"""A recording as a rerun file: the needle in 3-D, its signals, its parameters.

Output only: nothing that computes imports this module. Times are whole
nanoseconds; columns go in at once, so a run of a minute takes milliseconds.
"""

import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import rerun as rr
import rerun.blueprint as rrb
from matplotlib import colormaps
from numpy.typing import NDArray

from models import units
from models.modes import InsertedNeedle
from models.needle import Needle
from models.tissue import Tissue
from models.user_text import in_markdown
from sim.kernel.mesh import XI_LEFT, XI_RIGHT
from sim.recording.recording import Recording, unit_of
from sim.recording.rerun_file import recorded
from sim.recording.shaft_places import node_places_mm

Array = NDArray[np.float64]

APPLICATION = "needle-torsion"
TIMELINE = "time"
_FRAMES_PER_S = 20  # of the 3-D needle; the plots show every sample
_MODES = 4
_PATH_FRAMES = 400
_ALONG = ", over depth in mm"
# The twist is shown by arrows across the shaft, longer than the shaft is thick.
_ARROW_MM, _ARROW_RADIUS_MM, _SHAFT_RADIUS_MM = 9.0, 0.5, 0.6
_PLOTS: dict[str, dict[str, tuple[str, list[int]]]] = {
    "angles": {
        "base_angle_deg": ("base", [90, 90, 90]),
        "tip_angle_deg": ("tip", [214, 39, 40]),
        "estimate_tip_deg": ("tip, estimated", [255, 127, 14]),
        "wanted_tip_deg": ("tip, wanted", [44, 160, 44]),
        "command_base_deg": ("base, commanded", [31, 119, 180]),
        "measured_base_deg": ("base, measured", [150, 150, 150]),
        "measured_tip_deg": ("tip, measured", [255, 152, 150]),
        "closed_form_tip_deg": ("tip, closed form", [44, 160, 44]),
        "native_tip_deg": ("tip, native needle", [148, 103, 189]),
    },
    "torque": {
        "base_torque_n_mm": ("base torque", [31, 119, 180]),
        "friction_n_mm": ("friction of the tissue", [148, 103, 189]),
        "tip_torque_n_mm": ("torque at the tip", [214, 39, 40]),
        "measured_torque_n_mm": ("base torque, measured", [158, 202, 225]),
        "estimate_bias_n_mm": ("bias of the sensor, estimated", [255, 127, 14]),
    },
    "limits": {
        "rate_limited_count": ("at the motor's rate", [188, 189, 34]),
        "torque_limited_count": ("at the motor's torque", [227, 119, 194]),
    },
    "lengths": {
        "inserted_mm": ("inserted", [140, 86, 75]),
        "free_mm": ("free", [127, 127, 127]),
    },
    "speed": {"speed_mm_s": ("into the tissue", [140, 86, 75])},
    "energy": {
        "drive_work_mj": ("work of the drive", [31, 119, 180]),
        "dissipated_mj": ("dissipated", [148, 103, 189]),
        "torsion_energy_mj": ("stored in the shaft", [140, 86, 75]),
        "tissue_energy_mj": ("stored in the tissue", [44, 160, 44]),
    },
    "stress": {"shear_stress_mpa": ("largest in the shaft", [214, 39, 40])},
    "solver": {
        "newton_iterations_count": ("iterations of the step", [31, 119, 180]),
        "unconverged_count": ("stages that did not converge, so far", [214, 39, 40]),
    },
    "correction": {"correction_n_mm": ("correction to second order", [127, 127, 127])},
}


def log_recording(
    recording: Recording,
    path: Path,
    *,
    measured: pd.DataFrame | None = None,
    results: Sequence[str] = (),
    force: bool = False,
) -> None:
    """Write a recording as `.rrd`, already arranged.

    Args:
      measured: signals of a rig to be shown beside those of the recording, with their own `time_s`.
      results: lines of text that the recording shows under its title.

    Raises:
      OutputExists: the path exists and `force` is not given.
    """
    with recorded(application(recording), blueprint(recording), path, force=force) as stream:
        _log_text(stream, recording, results)
        _log_plots(stream, recording.table)
        if measured is not None:
            _log_plots(stream, measured)
        _log_modes(stream, recording)
        _log_path(stream, recording)
        _log_shaft(stream, recording)


def application(recording: Recording) -> str:
    """The application of a recording: a viewer keeps one layout for each, so that recordings with
    other views are another application."""
    return APPLICATION + "".join(
        f"-{name}" for name, there in _optional_views(recording).items() if there
    )


def _optional_views(recording: Recording) -> dict[str, bool]:
    """Which views a recording has besides those that all have."""
    return {
        "shaft": recording.group("shaft").size > 0,
        "tissue": recording.group("tissue").size > 0,
        "control": "rate_limited_count" in recording.table,
    }


def blueprint(recording: Recording) -> Any:
    """Needle above tissue on the left, plots in the middle, text on the right."""
    plots = [
        rrb.TimeSeriesView(origin="/angles", name="Angles, deg"),
        rrb.TimeSeriesView(origin="/torque", name="Torque, N mm"),
        rrb.TimeSeriesView(origin="/modes", name="Modal amplitudes, deg"),
        rrb.TimeSeriesView(origin="/lengths", name="Lengths, mm"),
    ]
    left: list[Any] = [rrb.Spatial3DView(origin="/world", name="Needle")]
    there = _optional_views(recording)
    if there["shaft"]:
        left.append(rrb.BarChartView(origin="/profile/shaft", name=f"Lag behind the base, deg{_ALONG}"))
    if there["tissue"]:
        left.append(rrb.BarChartView(origin="/profile/tissue", name=f"Twist of the tissue, deg{_ALONG}"))
    if there["control"]:
        plots.append(rrb.TimeSeriesView(origin="/limits", name="Limits reached"))
        plots.append(rrb.TimeSeriesView(origin="/estimate", name="Modes of the estimator, deg"))
    checks = [
        rrb.TimeSeriesView(origin="/energy", name="Energy, mJ"),
        rrb.TimeSeriesView(origin="/stress", name="Shear stress, MPa"),
        rrb.TimeSeriesView(origin="/speed", name="Speed, mm/s"),
        rrb.TimeSeriesView(origin="/correction", name="Correction to second order, N mm"),
        rrb.TimeSeriesView(origin="/solver", name="Solver"),
    ]
    text = rrb.TextDocumentView(origin="/about", name="About")
    return rrb.Blueprint(
        rrb.Horizontal(
            rrb.Vertical(*left, row_shares=[2] + [1] * (len(left) - 1)),
            rrb.Tabs(
                rrb.Vertical(*plots, name="Motion"),
                rrb.Vertical(*checks, name="Energy, stress, solver"),
            ),
            text,
            column_shares=[3, 4, 2],
        ),
        collapse_panels=True,
    )


def time_column(time_s: Array) -> Any:
    """Times as whole nanoseconds."""
    nanoseconds = np.round(time_s * 1e9).astype("timedelta64[ns]")
    return rr.TimeColumn(TIMELINE, duration=nanoseconds)


def log_series(
    stream: rr.RecordingStream,
    path: str,
    label: str,
    time_s: Array,
    values: Array,
    colour: list[int],
) -> None:
    """One line of a plot."""
    stream.log(path, rr.SeriesLines(colors=[colour], names=[label]), static=True)
    stream.send_columns(path, indexes=[time_column(time_s)], columns=rr.Scalars.columns(scalars=values))


def _log_plots(stream: rr.RecordingStream, table: pd.DataFrame) -> None:
    time_s = np.asarray(table["time_s"], float)
    for plot, signals in _PLOTS.items():
        for name, (label, colour) in signals.items():
            if name in table:
                values = np.asarray(table[name], float)
                log_series(stream, f"{plot}/{name}", label, time_s, values, colour)


def _log_text(stream: rr.RecordingStream, recording: Recording, results: Sequence[str]) -> None:
    lines = [f"# {in_markdown(str(recording.parameters.get('protocol', 'Recording')))}", ""]
    lines += [in_markdown(str(recording.parameters.get("description", ""))), ""]
    lines += [f"- {in_markdown(line)}" for line in results]
    lines += ["", "## Signals", ""]
    lines += [f"- `{name}`, {unit_of(name)}" for name in recording.names]
    text = json.dumps(recording.parameters, indent=1)
    lines += ["", "## Parameters", "", "```json", text, "```"]
    stream.log("about", rr.TextDocument("\n".join(lines), media_type="text/markdown"), static=True)


def modal_amplitudes_deg(recording: Recording, count: int = _MODES) -> Array | None:
    """Amplitudes of the closed form's modes in the shaft's shape, deg, (N, count).

    The lag behind the base, theta - u, in the modes of the base-driven needle at each
    depth. None where the recording keeps no shape or the tissue has no damping.
    """
    angles, nodes = recording.group("shaft"), recording.parameters.get("nodes_mm")
    if not angles.size or nodes is None:
        return None
    tissue = Tissue(**recording.parameters["tissue"])
    damping = tissue.layers[0].interface.viscous_n_mm_s_per_mm
    if damping == 0 or recording["inserted_mm"].max() <= 0:
        return None
    needle = Needle(**recording.parameters["needle"])
    lag = angles - recording["base_angle_deg"][:, None]
    amplitudes = np.zeros((len(lag), count))
    x, cache = np.array(nodes), {}
    for i, (free, inserted) in enumerate(
        zip(recording["free_mm"], recording["inserted_mm"], strict=True)
    ):
        key = (round(free, 1), round(inserted, 1))
        if inserted <= 1.0:
            continue
        if key not in cache:
            cache[key] = _projector(needle, damping, *key, x, recording.parameters["stretching"], count)
        amplitudes[i] = cache[key] @ lag[i]
    return amplitudes


def _projector(
    needle: Needle,
    damping: float,
    free: float,
    inserted: float,
    nodes: Array,
    stretching: int,
    count: int,
) -> Array:
    """Matrix from angles at the nodes to amplitudes: least squares on the inserted nodes."""
    held = InsertedNeedle(
        needle=needle, damping_n_mm_s_per_mm=damping, inserted_mm=inserted, free_mm=free
    )
    depth = nodes - nodes[stretching] if stretching else nodes - free
    inside = (depth >= -1e-6) & (depth <= inserted + 1e-6)
    shapes = np.cos(np.outer(inserted - depth[inside], held.wavenumbers_per_mm(count)))
    projector = np.zeros((count, nodes.size))
    projector[:, inside] = np.linalg.pinv(shapes)
    return projector


def _log_modes(stream: rr.RecordingStream, recording: Recording) -> None:
    """Modes of the shaft, in those of the closed form; and an estimator's own, if there is one."""
    amplitudes = modal_amplitudes_deg(recording)
    if amplitudes is not None:
        for k in range(_MODES):
            _log_mode(stream, "modes", k, recording["time_s"], amplitudes[:, k])
    names = [str(n) for n in recording.table.columns if str(n).startswith("estimate_mode_")]
    for k, name in enumerate(names):
        _log_mode(stream, "estimate", k, recording["time_s"], recording[name])


def _log_mode(stream: rr.RecordingStream, plot: str, k: int, time_s: Array, values: Array) -> None:
    colour = (np.array(colormaps["Set2"](k % 8))[:3] * 255).astype(int).tolist()
    log_series(stream, f"{plot}/{k + 1}", f"mode {k + 1}", time_s, values, colour)


def _log_path(stream: rr.RecordingStream, recording: Recording) -> None:
    """The path of a steered tip, and where the tip is on it."""
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


def _log_shaft(stream: rr.RecordingStream, recording: Recording) -> None:
    """The shaft, arrows that show its twist, coloured by lag, and the tissue as a box."""
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
    """Bars at their places along the shaft; the viewer takes one frame of bars at a time.

    Args:
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
    """Bars that do not overlap: as wide as the nearer neighbour is far; the ends as their neighbours."""
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
