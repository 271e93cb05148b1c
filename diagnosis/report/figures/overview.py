"""The whole in pictures: the residual by part, the ranking, and every trial along time."""

from collections.abc import Sequence

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from diagnosis.log.trial import SENSORS
from diagnosis.report.figures.style import LABELS, MEASURED, PREDICTIONS
from diagnosis.residuals.trial_residual import trial_residuals
from diagnosis.result import Diagnosis
from models.user_text import in_figure


def _bars(axis: Axes, names: Sequence[str], values: Sequence[Sequence[float]], title: str) -> None:
    rows = np.arange(len(names))
    for shift, (label, colour), own in zip((-0.2, 0.2), PREDICTIONS.items(), values, strict=True):
        axis.barh(rows + shift, own, 0.4, color=colour, label=label)
    axis.axvline(1.0, color="k", lw=1)
    axis.set_yticks(rows, names, fontsize=8)
    axis.invert_yaxis()
    axis.set_title(title, fontsize=10)


def draw_breakdown(found: Diagnosis) -> Figure:
    """Residual / sigma of nominal and explained, by part."""
    figure, axes = plt.subplots(1, 4, figsize=(13, 3), layout="constrained")
    both = (found.assessment.breakdown, found.assessment.breakdown_after)
    signals, phases = list(both[0].signal), list(both[0].phase)
    bands = [f"{low:g} to {high:g} Hz" for low, high, _ in both[0].band_hz]
    depths = [f"{depth:g} mm" for depth, _ in both[0].depth_mm]
    _bars(axes[0], signals, [[w.signal[k] for k in signals] for w in both], "by signal")
    _bars(axes[1], phases, [[w.phase[k] for k in phases] for w in both], "by phase of the motion")
    _bars(axes[2], bands, [[v for *_, v in w.band_hz] for w in both], "by frequency")
    _bars(axes[3], depths, [[v for _, v in w.depth_mm] for w in both], "by depth")
    axes[0].legend(fontsize=7)
    figure.supxlabel("residual / σ; the line is the noise floor", fontsize=9)
    return figure


def draw_ranking(found: Diagnosis) -> Figure:
    """The first of the ranking."""
    figure, axis = plt.subplots(figsize=(8, 2.6), layout="constrained")
    best = found.verdict.ranking[:6]
    axis.barh(range(len(best)), [p for _, p in best], color="tab:red")
    axis.set_yticks(range(len(best)), [n for n, _ in best], fontsize=9)
    axis.invert_yaxis()
    axis.set(xlim=(0, 1), xlabel="probability")
    return figure


def draw_trials(found: Diagnosis) -> Figure:
    """Measured, nominal and explained of every trial, residuals below."""
    count = len(found.log.trials)
    figure, axes = plt.subplots(
        2 * count, 2, figsize=(13, 4.2 * count), layout="constrained", squeeze=False
    )
    both = {"nominal": found.nominal, "explained": found.assessment.explained}
    left = {name: trial_residuals(found.log, own, found.noise) for name, own in both.items()}
    for i, trial in enumerate(found.log.trials):
        for j, sensor in enumerate(SENSORS):
            above, below, time = axes[2 * i, j], axes[2 * i + 1, j], trial["time_s"]
            if trial.has(sensor):
                above.plot(time, trial[sensor], color=MEASURED, lw=0.8, label="measured")
                below.axhspan(-2, 2, color="0.9", zorder=0)
            for name, colour in PREDICTIONS.items():
                above.plot(time, both[name][i][sensor], color=colour, lw=1, label=name)
                if trial.has(sensor):
                    below.plot(time, left[name][i].left[sensor], color=colour, lw=0.5)
            above.set_title(in_figure(f"{trial.name}: {LABELS[sensor]}"), fontsize=9, loc="left")
            below.set(ylabel="residual / σ", xlabel="time, s")
            below.set_ylim(*_limits_of(below))
    axes[0, 0].legend(fontsize=8)
    return figure


def _limits_of(axis: Axes) -> tuple[float, float]:
    """Residual limits that a few outliers do not set."""
    values = [np.asarray(line.get_ydata(), float) for line in axis.get_lines()]
    finite = np.concatenate([v[np.isfinite(v)] for v in values]) if values else np.zeros(1)
    reach = max(4.0, float(np.quantile(np.abs(finite), 0.995)) * 1.1)
    return -reach, reach
