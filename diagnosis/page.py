"""`report.html`: the diagnosis for people, in one file that opens without a network."""

import base64
import html
import io
from collections.abc import Callable
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from diagnosis.diagnose import Diagnosis
from diagnosis.rig_log import SENSORS
from diagnosis.verdict import Outcome

_LABELS = {"tip_angle_deg": "tip, deg", "base_torque_n_mm": "base torque, N mm"}
_STYLE = """body{font:16px/1.5 system-ui,sans-serif;max-width:1000px;margin:2em auto;padding:0 1em;
color:#222}h1{font-size:1.5em}h2{font-size:1.15em;margin-top:2em}img{max-width:100%}
table{border-collapse:collapse}td,th{border-bottom:1px solid #ccc;padding:.2em .8em;text-align:left}
.warning{background:#fff3cd;padding:.5em 1em}"""


def sentence(found: Diagnosis) -> str:
    """The verdict in one sentence."""
    gap, names = found.gap, " and ".join(found.verdict.effects)
    match found.verdict.outcome:
        case Outcome.NONE:
            return f"none: nothing beyond noise (gap {gap.before:.2f})"
        case Outcome.EXPLAINED:
            verb = "bring" if len(found.verdict.effects) > 1 else "brings"
            return f"explained: {names} {verb} the gap from {gap.before:.2f} to {gap.after:.2f} noise"
        case Outcome.UNDECIDED:
            sets = ", or ".join(" and ".join(s) for s in found.verdict.confusable)
            return f"undecided: {sets} explain the gap of {gap.before:.2f} noise alike"
        case _:
            return (
                f"unknown: a gap of {gap.before:.2f} noise, of which no effect of the library, "
                f"nor any pair that was tried, leaves less than {gap.after:.2f}"
            )


def page(found: Diagnosis, report: dict[str, Any]) -> str:
    """The whole page; `report` is report.json."""
    parts = [f"<h1>{html.escape(sentence(found))}</h1>"]
    parts += [f'<p class="warning">{html.escape(w)}</p>' for w in report["warnings"]]
    parts += ["<h2>Where the gap lives</h2>", _picture(found, _draw_where)]
    parts += ["<h2>Which effects explain it</h2>", _picture(found, _draw_ranking)]
    if report["parameters"]:
        parts.append(_parameters(report["parameters"]))
    parts += ["<h2>How far it shrinks</h2>", f"<p>{_shrinkage(found)}</p>"]
    parts += ["<h2>Measured, nominal and explained</h2>", _picture(found, _draw_trials)]
    parts += ["<h2>What cannot be told</h2>", f"<p>{html.escape(_limits(found, report))}</p>"]
    body = "\n".join(parts)
    return (
        '<!doctype html><html lang="en"><head><meta charset="utf-8"><title>Gap report</title>'
        f"<style>{_STYLE}</style></head><body>{body}</body></html>\n"
    )


def _shrinkage(found: Diagnosis) -> str:
    gap = found.gap
    return (
        f"On trials that the fit has not seen the residual falls from {gap.before:.2f} to "
        f"{gap.after:.3f} in units of noise: {100 * gap.shrink:.1f} % "
        f"(95 % interval {100 * gap.shrink_low:.1f} to {100 * gap.shrink_high:.1f} %). "
        "1 is the noise floor."
    )


def _limits(found: Diagnosis, report: dict[str, Any]) -> str:
    missing = [s for s in SENSORS if not any(t.has(s) for t in found.log.trials)]
    lines = [f"{s} was not measured: effects that show only there stay open." for s in missing]
    advice = report["next_experiment"]
    return " ".join([*lines, advice] if advice else lines) or "Nothing that the data leave open."


def _parameters(parameters: dict[str, Any]) -> str:
    rows = [
        f"<tr><td>{effect}</td><td>{name}</td><td>{p['value']:.4g}</td>"
        f"<td>{p['low']:.4g} to {p['high']:.4g}</td><td>{p['unit']}</td></tr>"
        for effect, values in parameters.items()
        for name, p in values.items()
    ]
    head = "<tr><th>effect</th><th>parameter</th><th>value</th><th>95 % interval</th><th>unit</th></tr>"
    return f"<table>{head}{''.join(rows)}</table>"


def _picture(found: Diagnosis, draw: Callable[[Diagnosis], Figure]) -> str:
    figure = draw(found)
    buffer = io.BytesIO()
    figure.savefig(buffer, dpi=90, format="png")
    plt.close(figure)
    return f'<img alt="" src="data:image/png;base64,{base64.b64encode(buffer.getvalue()).decode()}">'


def _bars(axis: Axes, names: list[str], values: list[float], title: str) -> None:
    axis.barh(range(len(names)), values, color="tab:blue")
    axis.axvline(1.0, color="k", lw=1)
    axis.set_yticks(range(len(names)), names, fontsize=8)
    axis.invert_yaxis()
    axis.set_title(title, fontsize=10)


def _draw_where(found: Diagnosis) -> Figure:
    figure, axes = plt.subplots(1, 4, figsize=(13, 3), layout="constrained")
    where = found.where
    _bars(axes[0], list(where.signal), list(where.signal.values()), "by signal")
    _bars(axes[1], list(where.phase), list(where.phase.values()), "by phase of the motion")
    bands = [f"{low:g} to {high:g} Hz" for low, high, _ in where.band_hz]
    _bars(axes[2], bands, [v for *_, v in where.band_hz], "by frequency")
    _bars(axes[3], [f"{d:g} mm" for d, _ in where.depth_mm], [v for _, v in where.depth_mm], "by depth")
    figure.supxlabel("residual of the nominal model over noise; the line is the noise floor", fontsize=9)
    return figure


def _draw_ranking(found: Diagnosis) -> Figure:
    figure, axis = plt.subplots(figsize=(8, 2.6), layout="constrained")
    best = found.verdict.ranking[:6]
    axis.barh(range(len(best)), [p for _, p in best], color="tab:red")
    axis.set_yticks(range(len(best)), [n for n, _ in best], fontsize=9)
    axis.invert_yaxis()
    axis.set(xlim=(0, 1), xlabel="probability")
    return figure


def _draw_trials(found: Diagnosis) -> Figure:
    count = len(found.log.trials)
    figure, axes = plt.subplots(
        2 * count, 2, figsize=(13, 4.2 * count), layout="constrained", squeeze=False
    )
    each = zip(found.log.trials, found.nominal, found.explained, strict=True)
    for i, (trial, nominal, explained) in enumerate(each):
        for j, sensor in enumerate(SENSORS):
            above, below, time = axes[2 * i, j], axes[2 * i + 1, j], trial["time_s"]
            if trial.has(sensor):
                above.plot(time, trial[sensor], color="0.6", lw=0.8, label="measured")
                below.axhspan(-2, 2, color="0.9", zorder=0)
                for prediction, colour in ((nominal, "tab:blue"), (explained, "tab:red")):
                    left = (trial[sensor] - prediction[sensor]) / found.noise[sensor]
                    below.plot(time, left, color=colour, lw=0.5)
            above.plot(time, nominal[sensor], color="tab:blue", lw=1, label="nominal")
            above.plot(time, explained[sensor], color="tab:red", lw=1, label="explained")
            above.set_title(f"{trial.name}: {_LABELS[sensor]}", fontsize=9, loc="left")
            below.set(ylabel="over noise", xlabel="time, s")
            below.set_ylim(*_limits_of(below))
    axes[0, 0].legend(fontsize=8)
    return figure


def _limits_of(axis: Axes) -> tuple[float, float]:
    """Residual limits that a few outliers do not set."""
    values = [np.asarray(line.get_ydata(), float) for line in axis.get_lines()]
    finite = np.concatenate([v[np.isfinite(v)] for v in values]) if values else np.zeros(1)
    reach = max(4.0, float(np.quantile(np.abs(finite), 0.995)) * 1.1)
    return -reach, reach
