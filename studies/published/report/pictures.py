"""The three pictures of the page."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from diagnosis.report.figures.layout import subplots
from models import published
from sim.needles.run import Run
from sim.simulation import simulate
from studies.published.criteria import ELEMENTS, RESOLVED_SIGMA
from studies.published.experiments.measurement import TurnExperiment
from studies.published.experiments.rig import STATED
from studies.published.experiments.schedules import schedule, step_s
from studies.published.fitting.fit import FigureFit
from studies.published.material_study import MaterialStudy
from studies.published.report.values import names_in_words

_SHOWN_FITS, _SHOWN_ACCEPTED = 24, 3
_BAR = 0.15
_COLOURS = ("tab:blue", "tab:cyan", "tab:red", "tab:orange", "tab:green")


def _leading(study: MaterialStudy) -> list[FigureFit]:
    """The stated rig with each free length, and the best explanations."""
    return [*study.stated, *study.verdict.leading[:_SHOWN_ACCEPTED]]


def _label(fit: FigureFit) -> str:
    names = fit.hypothesis.names
    return f"{names_in_words(names) if names else 'stated'}, {fit.hypothesis.free_length}"


def draw_residuals(study: MaterialStudy) -> Figure:
    """Draw the residual of every figure for the stated rig and the leading explanations."""
    figure, axis = subplots(figsize=(11, 3.6))
    place = np.arange(len(study.figures))
    axis.axhspan(-RESOLVED_SIGMA, RESOLVED_SIGMA, color="0.92")
    axis.axhline(0, color="k", lw=1)
    fits = _leading(study)
    for i, (fit, colour) in enumerate(zip(fits, _COLOURS, strict=False)):
        left = place + (i - len(fits) / 2) * _BAR
        axis.bar(left, fit.residual, _BAR, color=colour, label=_label(fit))
    axis.set_xticks(place, [f.name.replace(", ", "\n") for f in study.figures], fontsize=8)
    axis.set_ylabel("(simulated - published) / σ")
    axis.legend(fontsize=8)
    return figure


def draw_quick_turns(study: MaterialStudy) -> Figure:
    """Draw tip and base over time in the quick turn, at both depths of Table IV."""
    figure, axes = subplots(1, 2, figsize=(11, 3.6), sharey=True)
    for axis, (depth_cm, row) in zip(axes, published.TABLE_IV_SETTLE_S.items(), strict=True):
        for fit, colour in zip(_leading(study), _COLOURS, strict=False):
            _draw_run(axis, _quick_turn(fit, 10 * depth_cm), colour, _label(fit))
        axis.axhspan(87, 93, color="0.92", zorder=0)
        axis.axvline(row[0], color="k", lw=1, ls="--")
        axis.set_title(f"{depth_cm:g} cm: tip and base (dotted); dashed: settled, Table IV")
        axis.set_xlabel("time, s")
    axes[0].set_ylabel("angle, deg")
    axes[1].legend(fontsize=8)
    return figure


def _quick_turn(fit: FigureFit, depth_mm: float) -> Run:
    rig, experiment = fit.hypothesis.rig(fit.x), TurnExperiment.QUICK_TURN
    inputs = schedule(experiment, depth_mm, rig)
    setup = rig.model.setup(STATED, inputs, elements=ELEMENTS, step_s=step_s(experiment))
    return simulate([setup], inputs)[0]


def _draw_run(axis: Axes, run: Run, colour: str, label: str) -> None:
    axis.plot(run.time_s, run.inputs.drive, color=colour, lw=0.8, ls=":")
    axis.plot(run.time_s, run.tip_deg, color=colour, lw=1.2, label=label)


def draw_fits(study: MaterialStudy) -> Figure:
    """Draw the root mean square residual of the best fits, and with each figure left out in turn."""
    fits = sorted(study.fits, key=lambda f: f.aicc)[:_SHOWN_FITS]
    figure, axis = subplots(figsize=(11, 0.24 * len(fits) + 1))
    colours = ["tab:red" if f in study.verdict.accepted else "0.7" for f in fits]
    rows = range(len(fits))
    axis.barh(rows, [f.rms_residual for f in fits], color=colours)
    axis.plot([f.rms_left_out for f in fits], rows, "k.", label="each figure left out in turn")
    axis.set_yticks(rows, [_label(f) for f in fits], fontsize=8)
    axis.axvline(1, color="k", lw=1)
    axis.set(xlabel="rms residual / σ (red: accepted)", xlim=(0, 6))
    axis.invert_yaxis()
    axis.legend(fontsize=8)
    return figure
