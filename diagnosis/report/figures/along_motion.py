"""The residual along the motion of the base: over its stroke, after a reversal, and by its rate."""

from collections.abc import Sequence

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from diagnosis.criteria import TURNING_DEG_S
from diagnosis.report.figures.style import LABELS, PREDICTIONS
from diagnosis.residuals.along_motion import BASE_ANGLE, RATE, SINCE_REVERSAL, Coordinate, part_means
from diagnosis.residuals.motion import direction
from diagnosis.residuals.trial_residual import TrialResidual, by_sensor, trial_residuals
from diagnosis.result import Diagnosis

Array = NDArray[np.float64]

_WAYS = {1.0: ("-", "forward"), -1.0: (":", "back")}


def draw_along_motion(found: Diagnosis) -> Figure:
    """Residual of each sensor against base angle, time since a reversal, and rate of the base."""
    explained = trial_residuals(found.log, found.assessment.explained, found.noise)
    nominal = by_sensor(trial_residuals(found.log, found.nominal, found.noise))
    both = {"nominal": nominal, "explained": by_sensor(explained)}
    figure, axes = plt.subplots(
        len(nominal), 3, figsize=(13, 2.9 * len(nominal)), layout="constrained", squeeze=False
    )
    for row, sensor in zip(axes, nominal, strict=True):
        for name, own in both.items():
            colour, residuals = PREDICTIONS[name], own[sensor]
            _draw_by_angle(row[0], residuals, sensor, colour, name)
            since, gap = _means(SINCE_REVERSAL, residuals, [r.left[sensor] ** 2 for r in residuals])
            row[1].plot(since, np.sqrt(gap), "o-", color=colour, ms=3)
            rate, mean = _means(RATE, residuals, [r.left[sensor] for r in residuals])
            row[2].plot(rate, mean, "o-", color=colour, ms=3)
        _label_motion(row, sensor)
    axes[0, 0].legend(fontsize=7)
    return figure


def _draw_by_angle(
    axis: Axes, residuals: Sequence[TrialResidual], sensor: str, colour: str, name: str
) -> None:
    """Mean residual along the stroke, each way by itself."""
    for way, (line, word) in _WAYS.items():
        own = [np.where(direction(r.trial) == way, r.left[sensor], np.nan) for r in residuals]
        angle, mean = _means(BASE_ANGLE, residuals, own)
        axis.plot(angle, mean, line, marker="o", ms=3, color=colour, label=f"{name}, {word}")


def _means(
    coordinate: Coordinate, residuals: Sequence[TrialResidual], values: Sequence[Array]
) -> tuple[Array, Array]:
    """Places and means in the parts of a coordinate."""
    places = [coordinate.of(residual.trial) for residual in residuals]
    means = part_means(places, values, coordinate.edges(places))
    both = np.asarray(means).reshape(-1, 2)
    return both[:, 0], both[:, 1]


def _label_motion(row: Sequence[Axes], sensor: str) -> None:
    row[0].set_title(f"{LABELS[sensor]}: along the stroke", fontsize=9, loc="left")
    row[0].set(xlabel="base angle, deg", ylabel="mean residual / σ")
    row[1].set_title("after a reversal", fontsize=9, loc="left")
    row[1].set(xlabel="time since the base turned back, s", ylabel="root mean square / σ", xscale="log")
    row[1].set_ylim(bottom=0)
    row[1].axhline(1, color="k", lw=1)
    row[2].set_title("against the rate of the base", fontsize=9, loc="left")
    row[2].set(xlabel="rate, deg/s", ylabel="mean residual / σ")
    row[2].set_xscale("symlog", linthresh=TURNING_DEG_S)
    row[1].minorticks_off()
    for axis in (row[0], row[2]):
        axis.axhline(0, color="k", lw=1)
