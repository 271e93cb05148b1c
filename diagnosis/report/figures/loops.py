"""Loops: torque and lag as the base turns to and fro, measured, nominal and explained.

The area of a loop of torque against base angle is the work that friction and damping take: at any
rate for dry friction, in proportion to the rate for damping. The lag (base minus tip) against torque is
the compliance of the shaft: a line for an elastic one, with a jump for play.
"""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from numpy.typing import NDArray

from diagnosis.log.trial import Trial
from diagnosis.prepare.noise.sensor_noise import Noise
from diagnosis.replay.prediction import Prediction
from diagnosis.report.figures.layout import subplots
from diagnosis.report.figures.style import (
    LABELS,
    LINES,
    MEASURED,
    PREDICTIONS,
    WIDE,
    block_means,
    rms,
)
from diagnosis.report.sentences.names import label_of
from diagnosis.residuals.between_readings import between_readings
from diagnosis.residuals.trial_residual import TrialResidual, trial_residuals
from diagnosis.result import Diagnosis
from models.user_text import in_figure

Array = NDArray[np.float64]

_TRIALS = 3
_POINTS = 1500
_BASE, _LAG = "base angle, deg", "lag (base − tip), deg"
_TORQUE = LABELS["base_torque_n_mm"]


def draw_loops(found: Diagnosis) -> Figure:
    """Loops of the trials that tell most, in the order of the log."""
    shown = telling_trials(found)
    rows, columns = len(shown), max(len(_pictures(found.log.trials[i])) for i in shown)
    figure, axes = subplots(rows, columns, figsize=(WIDE / 2 * columns, 3.0 * rows), squeeze=False)
    for row, i in zip(axes, shown, strict=True):
        trial = found.log.trials[i]
        predictions = {"nominal": found.nominal[i], "explained": found.assessment.explained[i]}
        pictures = _pictures(trial)
        for axis, (across, up) in zip(row, pictures, strict=False):
            _loop(axis, _columns(trial, trial), across, up).set(color=MEASURED, lw=3, label="measured")
            for name, own in predictions.items():
                line = _loop(axis, _columns(trial, own), across, up)
                line.set(color=PREDICTIONS[name], ls=LINES[name], lw=1, label=label_of(found, name))
            axis.set_title(in_figure(trial.name), fontsize=9, loc="left")
            axis.set(xlabel=across, ylabel=up)
        for axis in row[len(pictures) :]:
            axis.set_visible(False)
    axes[0, 0].legend(fontsize=8)
    return figure


def describe_loops(found: Diagnosis) -> str:
    """The picture in words."""
    told, best = [], label_of(found, "explained")
    for i in telling_trials(found):
        trial = found.log.trials[i]
        up = _pictures(trial)[0][1]
        read = _columns(trial, trial)[up]
        both = (found.nominal[i], found.assessment.explained[i])
        off, left = (rms([read - _columns(trial, own)[up]]) for own in both)
        told.append(
            f"{trial.name}: {up} from {np.nanmin(read):.3g} to {np.nanmax(read):.3g}; the nominal "
            f"loop is off by {off:.2g}, the {best} one by {left:.2g}"
        )
    return f"Loops, measured, nominal and {best}. {'. '.join(told)} (root mean square)."


def telling_trials(found: Diagnosis) -> list[int]:
    """Places in the log of the few trials whose loops differ most from those of the nominal rig."""
    residuals = trial_residuals(found.log, found.nominal, found.noise)
    first = np.argsort([-_visible(residual, found.noise) for residual in residuals], kind="stable")
    return sorted(int(i) for i in first[:_TRIALS])


def _visible(residual: TrialResidual, noise: Noise) -> float:
    """The residual beyond noise over the range of what was read: the larger of both sensors'."""
    beyond = {s: max(float(np.nanmean(left**2)) - 1, 0.0) for s, left in residual.left.items()}
    ranges = {s: float(np.nanmax(residual.trial[s]) - np.nanmin(residual.trial[s])) for s in beyond}
    return max((noise[s] * beyond[s] ** 0.5 / ranges[s] for s in beyond if ranges[s] > 0), default=0.0)


def _pictures(trial: Trial) -> list[tuple[str, str]]:
    """What is drawn across and up, of what the trial measured."""
    torque, tip = trial.has("base_torque_n_mm"), trial.has("tip_angle_deg")
    if torque and tip:
        return [(_BASE, _TORQUE), (_TORQUE, _LAG)]
    return [(_BASE, _TORQUE)] if torque else [(_BASE, _LAG)]


def _columns(trial: Trial, readings: Trial | Prediction) -> dict[str, Array]:
    """What can be drawn, of readings at the samples of a trial."""
    nothing = np.full(trial["time_s"].shape, np.nan)

    def of(sensor: str) -> Array:
        return between_readings(trial["time_s"], readings[sensor]) if trial.has(sensor) else nothing

    base = trial["base_angle_deg"]
    return {_BASE: base, _TORQUE: of("base_torque_n_mm"), _LAG: base - of("tip_angle_deg")}


def _loop(axis: Axes, columns: dict[str, Array], across: str, up: str) -> Line2D:
    """One line, of means over a few samples where there are many."""
    fine = np.isfinite(columns[across]) & np.isfinite(columns[up])
    (line,) = axis.plot(*(block_means(columns[name][fine], _POINTS) for name in (across, up)))
    return line
