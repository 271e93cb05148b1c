"""`paper.html`: the published rig's gap for people, in one file that opens without a network."""

import base64
import html
import io
from collections.abc import Iterable, Sequence

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.figure import Figure as Picture

from models import published
from sim.simulation import simulate
from studies.published.experiments.figures import Experiment
from studies.published.experiments.rig import STATED
from studies.published.experiments.schedules import ELEMENTS, STEP_S, schedule
from studies.published.fitting.fit import Fit, rms
from studies.published.report.sentences import limits, next_experiment, sentence, title
from studies.published.report.tables import (
    candidate_rows,
    compensator_rows,
    figure_rows,
    prospect_rows,
    word_rows,
)
from studies.published.study import Case, Study

_STYLE = """body{font:16px/1.5 system-ui,sans-serif;max-width:1100px;margin:2em auto;padding:0 1em;
color:#222}h1{font-size:1.4em}h2{font-size:1.15em;margin-top:2em}img{max-width:100%}
table{border-collapse:collapse;font-size:.85em}td,th{border-bottom:1px solid #ccc;
padding:.2em .7em;text-align:left;vertical-align:top}.warning{background:#fff3cd;padding:.5em 1em}"""
_SHOWN_FITS = 24
_NOTE = (
    "The paper states neither the compensator's gains nor its motor; those here are this project's own."
)
_COLOURS = ("tab:blue", "tab:cyan", "tab:red", "tab:orange", "tab:green")


def page(study: Study) -> str:
    """The whole page."""
    turned, held = study.plastisol, study.gelatin
    parts = [f"<h1>{html.escape(sentence(turned))}</h1>"]
    parts += [f'<p class="warning">{html.escape(w)}</p>' for w in study.warnings]
    parts += ["<h2>How much the figures can bear</h2>", _list(limits(study))]
    parts += [
        "<h2>Published, ours, ratio</h2>",
        _table(figure_rows(turned)),
        _picture(_draw_figures(turned)),
    ]
    parts += ["<h2>The quick turn</h2>", _picture(_draw_turns(turned))]
    parts += ["<h2>What could close the gap</h2>", _picture(_draw_gaps(turned))]
    parts += [_table(candidate_rows(turned))]
    parts += ["<h2>What the text says beyond the tables</h2>", _table(word_rows(turned))]
    parts += [
        "<h2>What would tell the explanations apart</h2>",
        f"<p>{html.escape(next_experiment(study))}</p>",
    ]
    parts += [_table(prospect_rows(study))]
    parts += [f"<h2>Gelatin</h2><p>{html.escape(sentence(held))}</p>", _table(figure_rows(held))]
    parts += [_table(candidate_rows(held)), _table(word_rows(held))]
    parts += ["<h2>The compensator's columns</h2>", f"<p>{_NOTE}</p>", _table(compensator_rows(study))]
    body = "\n".join(parts)
    return (
        '<!doctype html><html lang="en"><head><meta charset="utf-8"><title>The published gap</title>'
        f"<style>{_STYLE}</style></head><body>{body}</body></html>\n"
    )


def _list(lines: Iterable[str]) -> str:
    return f"<ul>{''.join(f'<li>{html.escape(line)}</li>' for line in lines)}</ul>"


def _table(rows: Sequence[Sequence[str]]) -> str:
    """A table whose first row is its head."""
    cells = [
        "".join(f"<{tag}>{html.escape(cell)}</{tag}>" for cell in row)
        for tag, row in zip(("th", *["td"] * (len(rows) - 1)), rows, strict=True)
    ]
    return f"<table>{''.join(f'<tr>{row}</tr>' for row in cells)}</table>"


def _picture(figure: Picture) -> str:
    buffer = io.BytesIO()
    figure.savefig(buffer, dpi=90, format="png")
    plt.close(figure)
    return f'<img alt="" src="data:image/png;base64,{base64.b64encode(buffer.getvalue()).decode()}">'


def _leading(case: Case) -> list[Fit]:
    """The stated rig in its readings, and what explains the figures best."""
    return [*case.stated, *(case.verdict.accepted[:3] or (case.verdict.best,))]


def _label(fit: Fit) -> str:
    return (
        f"{title(fit.hypothesis.names) if fit.hypothesis.names else 'stated'}, {fit.hypothesis.reading}"
    )


def _draw_figures(case: Case) -> Picture:
    figure, axis = plt.subplots(figsize=(11, 3.6), layout="constrained")
    place = np.arange(len(case.figures))
    axis.axhspan(-2, 2, color="0.92")
    axis.axhline(0, color="k", lw=1)
    fits = _leading(case)
    for i, (fit, colour) in enumerate(zip(fits, _COLOURS, strict=False)):
        axis.bar(place + (i - len(fits) / 2) * 0.15, fit.missed, 0.15, color=colour, label=_label(fit))
    axis.set_xticks(place, [f.name.replace(", ", "\n") for f in case.figures], fontsize=8)
    axis.set_ylabel("ours less published, spreads")
    axis.legend(fontsize=8)
    return figure


def _draw_turns(case: Case) -> Picture:
    figure, axes = plt.subplots(1, 2, figsize=(11, 3.6), layout="constrained", sharey=True)
    for axis, (depth_cm, row) in zip(axes, published.TABLE_IV_SETTLE_S.items(), strict=True):
        for fit, colour in zip(_leading(case), _COLOURS, strict=False):
            rig = fit.hypothesis.rig(fit.x)
            inputs = schedule(Experiment.QUICK_TURN, 10 * depth_cm, rig)
            step = STEP_S[Experiment.QUICK_TURN]
            run = simulate([rig.model.setup(STATED, inputs, elements=ELEMENTS, step_s=step)], inputs)[0]
            axis.plot(run.time_s, run.inputs.drive, color=colour, lw=0.8, ls=":")
            axis.plot(run.time_s, run.tip_deg, color=colour, lw=1.2, label=_label(fit))
        axis.axhspan(87, 93, color="0.92", zorder=0)
        axis.axvline(row[0], color="k", lw=1, ls="--")
        axis.set(
            title=f"{depth_cm:g} cm: tip and base (dotted); dashed: settled, Table IV", xlabel="time, s"
        )
    axes[0].set_ylabel("angle, deg")
    axes[1].legend(fontsize=8)
    return figure


def _draw_gaps(case: Case) -> Picture:
    fits = sorted(case.fits, key=lambda f: f.aicc)[:_SHOWN_FITS]
    figure, axis = plt.subplots(figsize=(11, 0.24 * len(fits) + 1), layout="constrained")
    colours = ["tab:red" if f in case.verdict.accepted else "0.7" for f in fits]
    axis.barh(range(len(fits)), [f.gap for f in fits], color=colours)
    axis.plot(
        [rms(f.left_out) for f in fits], range(len(fits)), "k.", label="each figure left out in turn"
    )
    axis.set_yticks(range(len(fits)), [_label(f) for f in fits], fontsize=8)
    axis.axvline(1, color="k", lw=1)
    axis.set(xlabel="gap, spreads (red: accepted)", xlim=(0, 6))
    axis.invert_yaxis()
    axis.legend(fontsize=8)
    return figure
