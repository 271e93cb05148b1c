"""The residual by part: bars by signal, phase of the motion, frequency and depth."""

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from diagnosis.in_sigma import over_sigma
from diagnosis.report.figures.layout import subplots
from diagnosis.report.figures.style import HATCHES, PREDICTIONS, WIDE
from diagnosis.report.sentences.names import label_of
from diagnosis.residuals.residual_breakdown import band_name
from diagnosis.result import Diagnosis


def draw_breakdown(found: Diagnosis) -> Figure:
    """Residual / sigma of nominal and explained, by part."""
    labels = [label_of(found, name) for name in PREDICTIONS]
    figure, axes = subplots(1, 4, figsize=(WIDE, 3))
    both = (found.assessment.breakdown, found.assessment.breakdown_after)
    signals, phases = list(both[0].signal), list(both[0].phase)
    bands = [band_name(low, high) for low, high, _ in both[0].band_hz]
    depths = [f"{depth:g} mm" for depth, _ in both[0].depth_mm]
    _bars(axes[0], signals, [[w.signal[k] for k in signals] for w in both], "by signal")
    _bars(axes[1], phases, [[w.phase[k] for k in phases] for w in both], "by phase of the motion")
    _bars(axes[2], bands, [[v for *_, v in w.band_hz] for w in both], "by frequency")
    _bars(axes[3], depths, [[v for _, v in w.depth_mm] for w in both], "by depth")
    axes[0].legend(axes[0].containers, labels, fontsize=8)  # not the line of the noise floor
    figure.supxlabel("residual / σ; the line is the noise floor", fontsize=9)
    return figure


def describe_breakdown(found: Diagnosis) -> str:
    """The picture in words."""
    before, after = found.assessment.breakdown, found.assessment.breakdown_after
    best = label_of(found, "explained")
    parts = [(k, v, after.signal[k]) for k, v in before.signal.items()]
    parts += [(k, v, after.phase[k]) for k, v in before.phase.items()]
    each = [f"{name} {over_sigma(nominal)} and {over_sigma(left)}" for name, nominal, left in parts]
    return f"Bars of residual / σ, nominal and {best}: {'; '.join(each)}. 1 is the noise floor."


def _bars(axis: Axes, names: Sequence[str], values: Sequence[Sequence[float]], title: str) -> None:
    rows = np.arange(len(names))
    for shift, (label, colour), own in zip((-0.2, 0.2), PREDICTIONS.items(), values, strict=True):
        bars = axis.barh(rows + shift, own, 0.4, color=colour, label=label)
        for bar in bars:
            bar.set(hatch=HATCHES[label], edgecolor="white", linewidth=0)
    axis.axvline(1.0, color="k", lw=1)
    axis.set_yticks(rows, names, fontsize=9)
    axis.invert_yaxis()
    axis.set_title(title, fontsize=10)
