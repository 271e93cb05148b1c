"""The structure of the residual: its spectrum and its autocorrelation, beside those of white noise."""

from collections.abc import Mapping

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from diagnosis.report.figures.layout import subplots
from diagnosis.report.figures.style import LABELS, LINES, PREDICTIONS, WIDE
from diagnosis.report.sentences.names import label_of
from diagnosis.residuals.residual_shape import ResidualShape
from diagnosis.result import Diagnosis


def draw_memory(found: Diagnosis) -> Figure:
    """Spectrum and autocorrelation of the residual of each sensor, with what white noise has."""
    told = found.assessment
    shapes = {"nominal": told.shape, "explained": told.shape_after}
    sensors = list(told.breakdown.signal)
    figure, axes = subplots(len(sensors), 2, figsize=(WIDE, 2.9 * len(sensors)), squeeze=False)
    for row, sensor in zip(axes, sensors, strict=True):
        _draw_spectrum(row[0], sensor, shapes, label_of(found, "explained"))
        _draw_autocorrelation(row[1], sensor, shapes)
        for axis in row:
            axis.minorticks_off()  # they take half of the time
    if axes[0, 0].get_lines():
        axes[0, 0].legend(fontsize=7)
    return figure


def describe_memory(found: Diagnosis) -> str:
    """The picture in words: how far neighbouring samples tell of each other."""
    told, best = found.assessment, label_of(found, "explained")
    before, after = told.shape.autocorrelation, told.shape_after.autocorrelation
    each = [
        f"{LABELS[sensor].split(',')[0]} {before[sensor].lag_one_correlation:.2f}, {best} "
        f"{after[sensor].lag_one_correlation:.2f}"
        for sensor in before
        if sensor in after
    ]
    return (
        f"Spectrum and autocorrelation of the residual, nominal and {best}, beside white noise. "
        f"Correlation from one sample to the next: {'; '.join(each) or 'not known'}."
    )


def _draw_spectrum(axis: Axes, sensor: str, shapes: Mapping[str, ResidualShape], best: str) -> None:
    for name, shape in shapes.items():
        if sensor in shape.spectrum:
            hertz, power = np.transpose(shape.spectrum[sensor].power_per_hz)
            axis.loglog(
                hertz,
                power,
                color=PREDICTIONS[name],
                ls=LINES[name],
                label=best if name == "explained" else name,
            )
            white = shape.spectrum[sensor].white_per_hz
            axis.axhline(
                white, color="k", lw=1, ls=":", label="white noise" if name == "explained" else None
            )
    axis.set_title(f"{LABELS[sensor]}: spectrum of the residual", fontsize=9, loc="left")
    axis.set(xlabel="frequency, Hz", ylabel="σ² / Hz")
    if axis.get_lines():
        low, high = np.log10(axis.get_ylim())
        axis.set_ylim(10.0 ** np.floor(low), 10.0 ** np.ceil(high))  # a number at both ends at least


def _draw_autocorrelation(axis: Axes, sensor: str, shapes: Mapping[str, ResidualShape]) -> None:
    for name, shape in shapes.items():
        if sensor in shape.autocorrelation:
            own = shape.autocorrelation[sensor]
            axis.semilogx(*np.transpose(own.by_lag_s), color=PREDICTIONS[name], ls=LINES[name])
            if name == "explained":
                axis.axhspan(-own.white_limit, own.white_limit, color="0.85", zorder=0)
    axis.set_title(f"{LABELS[sensor]}: autocorrelation of the residual", fontsize=9, loc="left")
    axis.set(xlabel="lag, s", ylim=(-1.05, 1.05))
