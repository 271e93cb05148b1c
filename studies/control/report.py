"""The files of `needle control`: control.json, tables and pictures."""

import json
import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
from matplotlib.figure import Figure

from models.drive import DriveKind
from models.materials import tissue_named
from models.statespace import hankel_ratios
from sim.files import ResultSet, write_text
from sim.recording.html_table import html_table
from studies.control import tables
from studies.control.comparison import StepResponse, as_row, response_table
from studies.control.steering.steering_figures import draw_planes, draw_steered
from studies.control.steering.steering_report import steering_json
from studies.control.steering.steering_study import SteeringStudy
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
_IN_A_NOTEBOOK = (
    *("depth_cm", "free_mm", "controller", "settle_s", "published_settle_s"),
    *("integral_deg_s", "published_integral_deg_s", "overshoot_deg", "failed"),
)
_STYLES: dict[str, dict[str, Any]] = {
    "base_only": {"color": "0.5", "ls": "--"},
    "base_only_at_limit": {"color": "0.5", "ls": ":"},
    "feedforward": {"color": "tab:green", "lw": 5, "alpha": 0.45},  # feedback lies on it
    "feedback": {"color": "k", "ls": "--", "lw": 1},
    "lqr": {"color": "tab:purple", "ls": "-."},
    "least_time": {"color": "tab:red"},
}
"""The controllers of `turns.png`, told apart in grey, too."""


@dataclass(frozen=True, kw_only=True)
class ControlStudy:
    """All results of `needle control`."""

    tables: list[StepResponse]
    robustness: list[StepResponse]
    steering: SteeringStudy

    def _repr_html_(self) -> str:
        """Tables IV and V, for a notebook."""
        return html_table(
            "Tables IV and V: steps of 90 deg on the MuJoCo needle",
            response_table(self.tables)[[*_IN_A_NOTEBOOK]],
        )

    def as_json(self) -> dict[str, Any]:
        """The contents of `control.json`: `table_iv`, `table_v`, `steered_mm` and more."""
        return {
            "format": "needle-control/1",
            "table_iv": [_iv(o) for o in self.tables],
            "table_v": [_v(o) for o in self.tables],
            "robustness": [_plain(as_row(o)) for o in self.robustness],
            **steering_json(self.steering),
            "hankel_ratios": hankel(),
        }


def hankel(depth_mm: float = 200.0, modes: int = 6) -> list[float]:
    """Hankel values from torque to tip at a depth, relative to the largest: order 4 is enough."""
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


def write_study(study: ControlStudy, results: ResultSet, folder: Path) -> None:
    """Write all of `FILES` as results of a folder; a picture that fails is left out."""
    told, turns, robustness, *pictures = (folder / name for name in FILES)
    write_text(results.at(told), json.dumps(study.as_json(), indent=1, allow_nan=False))
    for path, responses in ((turns, study.tables), (robustness, study.robustness)):
        write_text(results.at(path), response_table(responses).to_csv(index=False))
    figures: tuple[Callable[[], Figure], ...] = (
        partial(_draw_turns, study),
        partial(draw_steered, study.steering),
        partial(draw_planes, study.steering),
    )
    for path, figure in zip(pictures, figures, strict=True):
        results.optional(path, partial(_draw, figure))


def _draw(make: Callable[[], Figure], path: Path) -> None:
    figure = make()
    figure.savefig(path, dpi=120, format="png")
    plt.close(figure)


def _draw_turns(study: ControlStudy) -> Figure:
    """Like Fig. 10: base and tip of each controller."""
    figure, axes = plt.subplots(2, 3, figsize=(14, 8), layout="constrained", sharey="row")
    for column, depth in enumerate(tables.DEPTHS_CM):
        for name, style in _STYLES.items():
            tissue = tissue_named("viscous-plastisol")
            run = turn(name, depth_cm=depth, free_mm=50.0, tissue=tissue).run
            shown = run.time_s < (2.0 if depth < 20 else 4.0)
            axes[0, column].plot(run.time_s[shown], run.inputs.drive[shown], label=name, **style)
            axes[1, column].plot(run.time_s[shown], run.tip_deg[shown], **style)
        axes[0, column].set(title=f"{depth:g} cm deep, 50 mm free")
        axes[1, column].axhspan(87, 93, color="0.9", zorder=0)
        axes[1, column].set(xlabel="time, s")
    axes[0, 0].set(ylabel="base, deg")
    axes[1, 0].set(ylabel="tip, deg (grey: within 3 deg)")
    figure.legend(*axes[0, 0].get_legend_handles_labels(), loc="outside lower center", ncols=6)
    return figure
