"""The residual along the motion of the base: over its stroke, after a reversal, and by its rate."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from diagnosis.criteria.residuals import TURNING_DEG_S
from diagnosis.in_sigma import over_sigma
from diagnosis.report.figures.layout import subplots
from diagnosis.report.figures.style import LABELS, LINES, PREDICTIONS, WIDE
from diagnosis.report.sentences.names import label_of
from diagnosis.residuals.along_motion import BASE_ANGLE, RATE, SINCE_REVERSAL, Coordinate, part_means
from diagnosis.residuals.motion import direction
from diagnosis.residuals.trial_residual import TrialResidual, by_sensor, trial_residuals
from diagnosis.result import Diagnosis

Array = NDArray[np.float64]

_WAYS = {1.0: (">", "forward"), -1.0: ("<", "back")}


def draw_along_motion(found: Diagnosis) -> Figure:
    """Residual of each sensor against base angle, time since a reversal, and rate of the base."""
    explained = trial_residuals(found.log, found.assessment.explained, found.noise)
    nominal = by_sensor(trial_residuals(found.log, found.nominal, found.noise))
    both = {"nominal": nominal, "explained": by_sensor(explained)}
    figure, axes = subplots(len(nominal), 3, figsize=(WIDE, 2.9 * len(nominal)), squeeze=False)
    for row, sensor in zip(axes, nominal, strict=True):
        for name, own in both.items():
            residuals = own[sensor]
            look: dict[str, Any] = {"color": PREDICTIONS[name], "ls": LINES[name], "ms": 4}
            _draw_by_angle(row[0], residuals, sensor, name, label_of(found, name))
            since, gap = _means(SINCE_REVERSAL, residuals, [r.left[sensor] ** 2 for r in residuals])
            row[1].plot(since, np.sqrt(gap), marker="o", **look)
            rate, mean = _means(RATE, residuals, [r.left[sensor] for r in residuals])
            row[2].plot(rate, mean, marker="o", **look)
        _label_motion(row, sensor)
    axes[0, 0].legend(fontsize=7)
    return figure


def describe_along_motion(found: Diagnosis) -> str:
    """The picture in words: the largest of each part."""
    told, best = found.assessment, label_of(found, "explained")
    parts = (
        ("along the stroke, at a base angle of", "deg", "base_angle_deg"),
        ("after a reversal, at", "s", "since_reversal_s"),
        ("against the rate, at", "deg/s", "rate_deg_s"),
    )
    each = [
        _largest(words, unit, best, getattr(told.shape, name), getattr(told.shape_after, name))
        for words, unit, name in parts
    ]
    return f"Residual / σ along the motion, nominal and {best}. Largest {'; '.join(filter(None, each))}."


def _largest(
    words: str,
    unit: str,
    best: str,
    before: Sequence[tuple[float, float]],
    after: Sequence[tuple[float, float]],
) -> str:
    """Where a coordinate has the largest residual, with that of the explanation at its largest."""
    if not before or not after:
        return ""
    place, value = max(before, key=lambda part: part[1])
    left = over_sigma(max(v for _, v in after))
    return f"{words} {place:.3g} {unit}: {over_sigma(value)}, {best} at most {left}"


def _draw_by_angle(
    axis: Axes, residuals: Sequence[TrialResidual], sensor: str, name: str, label: str
) -> None:
    """Mean residual along the stroke, each way by itself."""
    look: dict[str, Any] = {"color": PREDICTIONS[name], "ls": LINES[name], "ms": 5}
    for way, (mark, word) in _WAYS.items():
        own = [np.where(direction(r.trial) == way, r.left[sensor], np.nan) for r in residuals]
        angle, mean = _means(BASE_ANGLE, residuals, own)
        axis.plot(angle, mean, marker=mark, label=f"{label}, {word}", **look)


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
    row[1].axhline(1, color="k", lw=1)
    row[1].set_ylim(0, 1.1 * row[1].dataLim.ymax)
    row[2].set_title("against the rate of the base", fontsize=9, loc="left")
    row[2].set(xlabel="rate, deg/s", ylabel="mean residual / σ")
    row[2].set_xscale("symlog", linthresh=TURNING_DEG_S)
    row[2].tick_params(axis="x", labelsize=7)
    row[1].minorticks_off()
    for axis in (row[0], row[2]):
        axis.axhline(0, color="k", lw=1)
