"""One trial along time: measured, nominal and explained, with residuals below."""

from dataclasses import replace

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from diagnosis.in_sigma import in_sigma
from diagnosis.log.trial import SENSORS
from diagnosis.replay.prediction import Prediction
from diagnosis.report.figures.layout import subplots
from diagnosis.report.figures.style import (
    LABELS,
    LINES,
    MEASURED,
    PREDICTIONS,
    WHITE_BEHIND,
    WIDE,
    block_means,
    rms,
)
from diagnosis.report.sentences.names import best_in_words, label_of
from diagnosis.residuals.between_readings import between_readings
from diagnosis.residuals.trial_residual import TrialResidual, trial_residuals
from diagnosis.result import Diagnosis
from models.user_text import in_figure

Array = NDArray[np.float64]

_MEANS = 100  # of a trial


def draw_trial(found: Diagnosis, i: int) -> Figure:
    """Measured, nominal and explained of one trial, residuals below."""
    trial, predictions, left = found.log.trials[i], _predictions(found, i), _residuals(found, i)
    figure, axes = subplots(2, 2, figsize=(WIDE, 3.8), height_ratios=(3, 2), sharex=True)
    for (above, below), sensor in zip(axes.T, SENSORS, strict=True):
        time = trial["time_s"]
        if trial.has(sensor):
            measured = between_readings(time, trial[sensor])
            above.plot(time, measured, color=MEASURED, lw=1.6, label="measured")
            below.axhspan(-2, 2, color="0.9", zorder=0)
        for name, colour in PREDICTIONS.items():
            look = {"color": colour, "ls": LINES[name], "label": label_of(found, name)}
            above.plot(time, predictions[name][sensor], lw=1.2, **look)
            if trial.has(sensor):
                _draw_residual(below, time, left[name].left[sensor], name)
        above.set_title(in_figure(f"{trial.name}: {LABELS[sensor]}"), fontsize=10, loc="left")
        below.set(ylabel="residual / σ", xlabel="time, s")
        below.set_ylim(*_limits_of(below))
    axes[0, 0].legend(fontsize=8)
    return figure


def _draw_residual(axis: Axes, time_s: Array, residual: Array, name: str) -> None:
    """Every sample thinly, and means that differ in their line, too."""
    axis.plot(time_s, between_readings(time_s, residual), color=PREDICTIONS[name], lw=0.5, alpha=0.5)
    read = np.isfinite(residual)
    means = (block_means(own[read], _MEANS) for own in (time_s, residual))
    (line,) = axis.plot(*means, color=PREDICTIONS[name], ls=LINES[name], lw=1.8)
    line.set(path_effects=WHITE_BEHIND, gapcolor="white", zorder=3)


def describe_trial(found: Diagnosis, i: int) -> str:
    """The picture in words."""
    left = _residuals(found, i)
    told = "; ".join(
        f"{LABELS[sensor].split(',')[0]} {in_sigma(rms([own]))}, then {in_sigma(rms([after]))}"
        for (sensor, own), after in zip(
            left["nominal"].left.items(), left["explained"].left.values(), strict=True
        )
    )
    seconds = float(np.ptp(found.log.trials[i]["time_s"]))
    return (
        f"{found.log.trials[i].name} over {seconds:.0f} s: measured, nominal and "
        f"{label_of(found, 'explained')}, with residuals below. Residual of the nominal model, then of "
        f"{best_in_words(found)}: {told or 'none'}."
    )


def _predictions(found: Diagnosis, i: int) -> dict[str, Prediction]:
    return {"nominal": found.nominal[i], "explained": found.assessment.explained[i]}


def _residuals(found: Diagnosis, i: int) -> dict[str, TrialResidual]:
    """Of one trial, by prediction."""
    alone = replace(found.log, trials=(found.log.trials[i],))
    return {
        name: trial_residuals(alone, [own], found.noise)[0]
        for name, own in _predictions(found, i).items()
    }


def _limits_of(axis: Axes) -> tuple[float, float]:
    """Residual limits that a few outliers do not set."""
    values = [np.asarray(line.get_ydata(), float) for line in axis.get_lines()]
    finite = np.concatenate([v[np.isfinite(v)] for v in values]) if values else np.zeros(1)
    reach = max(4.0, float(np.quantile(np.abs(finite), 0.995)) * 1.1) if finite.size else 4.0
    return -reach, reach
