"""The files of `needle control`: control.json, tables and pictures."""

import json
import math
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from models.drive import DriveKind
from models.materials import tissue_named
from models.statespace import hankel_ratios
from sim.files import refuse_existing, write_text, writing
from studies.control import steering, tables
from studies.control.comparison import StepResponse, as_row
from studies.control.steering import PlaneApproach, SteeredInsertion
from studies.control.step_response import turn
from studies.crosscheck.poles import closed_form_needle

FILES = (
    "control.json",
    "tables_iv_v.csv",
    "robustness.csv",
    "turns.png",
    "steered.png",
    "planar.png",
)
_SHOWN = ("base_only", "base_only_at_limit", "feedforward", "feedback", "lqr", "least_time")


@dataclass(frozen=True, kw_only=True)
class ControlStudy:
    """All results of `needle control`."""

    tables: list[StepResponse]
    robustness: list[StepResponse]
    steered: list[SteeredInsertion]
    planes: dict[float, list[PlaneApproach]]

    def as_json(self) -> dict[str, Any]:
        """`table_iv`, `table_v`, `steered_mm` and the rest, in plain values."""
        return {
            "format": "needle-control/1",
            "table_iv": [_iv(o) for o in self.tables],
            "table_v": [_v(o) for o in self.tables],
            "robustness": [_plain(as_row(o)) for o in self.robustness],
            "steered_mm": {s.name: s.out_of_plane_mm for s in self.steered},
            "steered_published_mm": steering.PUBLISHED_MM,
            "planar_mm": {
                f"{speed:g} mm/s": {p.name: _or_none(p.converged_mm()) for p in approaches}
                for speed, approaches in self.planes.items()
            },
            "hankel_ratios": hankel(),
        }


def hankel(depth_mm: float = 200.0, modes: int = 6) -> list[float]:
    """Hankel values of torque to tip at a depth, over the largest: why order 4 is enough."""
    needle = closed_form_needle(depth_mm, 0.0, DriveKind.TORQUE)
    return [float(x) for x in hankel_ratios(needle, modes=modes)]


def _iv(o: StepResponse) -> dict[str, Any]:
    return _plain(
        {
            "depth_cm": o.depth_cm,
            "free_mm": o.free_mm,
            "controller": o.controller,
            "settle_s": o.settle_s,
            "better_percent": o.settle_better,
            "better_than_same_limits_percent": o.settle_better_same_limits,
            "overshoot_deg": o.overshoot_deg,
            "shear_stress_mpa": o.shear_stress_mpa,
            "published_s": o.published_settle_s,
            "ratio": o.settle_s / o.published_settle_s,
        }
    )


def _v(o: StepResponse) -> dict[str, Any]:
    return _plain(
        {
            "depth_cm": o.depth_cm,
            "free_mm": o.free_mm,
            "controller": o.controller,
            "integral_deg_s": o.integral_deg_s,
            "better_percent": o.integral_better,
            "better_than_same_limits_percent": o.integral_better_same_limits,
            "published_deg_s": o.published_integral_deg_s,
            "ratio": o.integral_deg_s / o.published_integral_deg_s,
        }
    )


def _plain(row: dict[str, Any]) -> dict[str, Any]:
    return {k: _or_none(v) for k, v in row.items()}


def _or_none(value: Any) -> Any:
    return None if isinstance(value, float) and math.isnan(value) else value


def write_study(study: ControlStudy, folder: Path, *, force: bool = False) -> list[Path]:
    """Write every file; returns their paths.

    Raises:
      OutputExists: one of them exists and `force` is not given.
    """
    paths = [folder / name for name in FILES]
    refuse_existing(paths, force=force)
    write_text(paths[0], json.dumps(study.as_json(), indent=1, allow_nan=False), force=force)
    for path, responses in ((paths[1], study.tables), (paths[2], study.robustness)):
        rows = pd.DataFrame([as_row(o) for o in responses])
        write_text(path, rows.to_csv(index=False), force=force)
    for path, draw in zip(paths[3:], (_draw_turns, _draw_steered, _draw_planes), strict=True):
        figure = draw(study)
        with writing(path, force=force) as part:
            figure.savefig(part, dpi=120, format="png")
        plt.close(figure)
    return paths


def _draw_turns(study: ControlStudy) -> Figure:
    """Like Fig. 10: base and tip of each controller."""
    figure, axes = plt.subplots(2, 3, figsize=(14, 8), layout="constrained", sharey="row")
    for column, depth in enumerate(tables.DEPTHS_CM):
        for name in _SHOWN:
            tissue = tissue_named("viscous-plastisol")
            run = turn(name, depth_cm=depth, free_mm=50.0, tissue=tissue).run
            shown = run.time_s < (2.0 if depth < 20 else 4.0)
            axes[0, column].plot(run.time_s[shown], run.inputs.drive[shown], lw=1, label=name)
            axes[1, column].plot(run.time_s[shown], run.tip_deg[shown], lw=1.2, label=name)
        axes[0, column].set(title=f"{depth:g} cm deep, 50 mm free")
        axes[1, column].axhspan(87, 93, color="0.9", zorder=0)
        axes[1, column].set(xlabel="time, s")
    axes[0, 0].set(ylabel="base, deg")
    axes[1, 0].set(ylabel="tip, deg (grey: within 3 deg)")
    axes[1, 2].legend(fontsize=8)
    return figure


def _draw_steered(study: ControlStudy) -> Figure:
    """Like Figs. 11 and 12: paths from above, and height over the plane."""
    figure, axes = plt.subplots(1, 2, figsize=(13, 5), layout="constrained")
    for one in study.steered:
        x, y, z = one.path_mm.T
        axes[0].plot(x, y, label=one.name)
        axes[1].plot(x, z, label=f"{one.name}: {one.out_of_plane_mm:.2f} mm")
    axes[0].set(xlabel="x, mm", ylabel="y, mm", title="From above", aspect="equal")
    axes[1].set(xlabel="x, mm", ylabel="height over the plane, mm", title="Out of the plane")
    axes[1].legend(fontsize=8)
    return figure


def _draw_planes(study: ControlStudy) -> Figure:
    count = len(study.planes)
    figure, axes = plt.subplots(1, count, figsize=(5 * count, 4.2), layout="constrained", squeeze=False)
    for axis, (speed, approaches) in zip(axes[0], study.planes.items(), strict=True):
        _draw_plane(axis, speed, approaches)
    return figure


def _draw_plane(axis: Axes, speed: float, approaches: list[PlaneApproach]) -> None:
    for one in approaches:
        axis.plot(one.travelled_mm, one.height_mm, label=f"{one.name}: {one.converged_mm():.0f} mm")
    limit = 1.2 * float(np.abs(approaches[0].height_mm).max())
    axis.axhspan(-0.5, 0.5, color="0.9", zorder=0)
    axis.set(xlabel="travelled, mm", ylabel="height over the plane, mm", ylim=(-limit, limit))
    axis.set_title(f"Planar controller at {speed:g} mm/s")
    axis.legend(fontsize=7, title="within 0.5 mm after", title_fontsize=7)
