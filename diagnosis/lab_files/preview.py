"""A picture of a draft: every guessed column over time, rests, reversals, and the loops.

If the angle of the base cannot be drawn over time, every column of the first trial is drawn over the
number of its row, so that a person can tell which is which.
"""

from collections.abc import Sequence
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from diagnosis.lab_files.guesses.draft import Draft
from diagnosis.lab_files.motion import Motion
from diagnosis.lab_files.readers.lab_table import LabTable
from diagnosis.lab_files.series import Series
from models.user_text import in_figure
from sim.files import writing

_MOST_TRIALS = 4
_MOST_POINTS = 5000
_MOST_COLUMNS, _COLUMNS_ABREAST = 48, 3


def write_preview(draft: Draft, path: Path) -> None:
    """Draw the first trials, values as they are in the files."""
    known = any("base_angle_deg" in own for own in draft.series.values())
    figure = _guesses_over_time(draft) if known else _columns_over_rows(draft.tables)
    try:
        with writing(path) as part:
            figure.savefig(part, dpi=100, format="png")
    finally:
        plt.close(figure)


def _guesses_over_time(draft: Draft) -> Figure:
    trials = list(draft.series)[:_MOST_TRIALS]
    names = [column.wanted for column in draft.columns]
    rows, columns = len(names), len(trials) + 1
    size = (3.6 * columns, 1.7 * rows + 1)
    figure, axes = plt.subplots(rows, columns, figsize=size, layout="constrained", squeeze=False)
    for axis in axes[:, -1]:
        axis.set_axis_off()
    for i, name in enumerate(names):
        source = next(column.source for column in draft.columns if column.wanted == name)
        axes[i, 0].set_ylabel(in_figure(f"{name}\n{source.column}"), fontsize=7)
        for k, trial in enumerate(trials):
            if name in draft.series[trial]:
                _over_time(axes[i, k], draft.series[trial][name], draft.motions.get(trial))
    for k, trial in enumerate(trials):
        axes[0, k].set_title(in_figure(trial), fontsize=9)
        axes[-1, k].set_xlabel("time in the files, s")
    _loops(axes[0, -1], draft, trials)
    return figure


def _columns_over_rows(tables: Sequence[LabTable]) -> Figure:
    drawn = [(table, name) for table in tables for name in table.columns][:_MOST_COLUMNS]
    rows = -(-len(drawn) // _COLUMNS_ABREAST)
    size = (4.5 * _COLUMNS_ABREAST, 1.7 * rows + 1)
    figure, axes = plt.subplots(
        rows, _COLUMNS_ABREAST, figsize=size, layout="constrained", squeeze=False
    )
    for axis in axes.flat[len(drawn) :]:
        axis.set_axis_off()
    for axis, (table, name) in zip(axes.flat, drawn, strict=False):
        few = _few(table.rows)
        axis.plot(np.arange(1, table.rows + 1)[few], table.columns[name][few], lw=0.7)
        axis.set_title(in_figure(name), fontsize=9)
    left_out = sum(len(table.columns) for table in tables) - len(drawn)
    beside = f" ({left_out} more columns are not drawn)" if left_out else ""
    figure.supxlabel(in_figure(f"row of {', '.join(table.title for table in tables)}{beside}"))
    return figure


def _over_time(axis: Axes, series: Series, motion: Motion | None) -> None:
    few = _few(series.time_s.size)
    axis.plot(series.time_s[few], series.values[few], lw=0.7, color="tab:blue")
    if motion is not None:
        for first, last in motion.rests_s:
            axis.axvspan(first, last, color="0.9", lw=0)
        for i in motion.reversals:
            axis.axvline(motion.time_s[i], color="tab:orange", lw=0.5)


def _loops(axis: Axes, draft: Draft, trials: list[str]) -> None:
    for trial in trials:
        own = draft.series[trial]
        if {"base_angle_deg", "base_torque_n_mm"} <= set(own):
            base, torque = own["base_angle_deg"], own["base_torque_n_mm"]
            few = _few(base.time_s.size)
            at = np.interp(base.time_s[few], torque.time_s, torque.values)
            axis.set_axis_on()
            axis.plot(base.values[few], at, lw=0.5)
            axis.set_title("torque over base angle", fontsize=9)


def _few(count: int) -> slice:
    return slice(None, None, max(1, count // _MOST_POINTS))
