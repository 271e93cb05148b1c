"""`report.html`: the diagnosis for people, in one file that opens without a network."""

import base64
import html
import io
import math
from collections.abc import Iterable
from typing import Any

import matplotlib.pyplot as plt
from matplotlib.figure import Figure

from diagnosis.diagnose import Diagnosis
from diagnosis.page_pictures import draw_ranking, draw_trials, draw_where
from diagnosis.page_tables import hidden_table, parameter_table
from diagnosis.verdict import ALIKE, NESTED, Outcome

_STYLE = """body{font:16px/1.5 system-ui,sans-serif;max-width:1000px;margin:2em auto;padding:0 1em;
color:#222}h1{font-size:1.5em}h2{font-size:1.15em;margin-top:2em}img{max-width:100%}
table{border-collapse:collapse}td,th{border-bottom:1px solid #ccc;padding:.2em .8em;text-align:left}
.warning{background:#fff3cd;padding:.5em 1em}"""


_WHERE = (
    "Root mean square of measured less predicted, in units of each sensor's noise: of the nominal "
    "model, and of what was made of it below."
)
_WHICH = (
    "Probability of each explanation, given the library, the noise and these trials. Two effects that "
    f"explain a log together share theirs. Odds below {math.exp(ALIKE / 2):.0f} to 1 decide nothing: "
    "a second effect, or more parameters, have to lead by more before they are named. An effect that "
    f"contains a simpler one has to lead that by {math.exp(NESTED / 2):.0f} to 1."
)
_HIDDEN = (
    "How strong each further effect may be and go unseen in these trials: of one that is stronger, "
    "95 in 100 logs like this would show it. A factor stands for its inverse too."
)
_TRIALS = (
    "Grey: measured. Below each signal: what each prediction misses it by, in units of noise; in the "
    "grey band lie 95 % of the samples if nothing but noise is left."
)


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
    parts += ["<h2>Where the gap lives</h2>", f"<p>{_WHERE}</p>", _picture(draw_where(found))]
    stretch, largest = found.where.worst
    parts.append(f"<p>Along time it is largest in {html.escape(stretch)}: {largest:.2f}.</p>")
    parts += ["<h2>Which effects explain it</h2>", f"<p>{_WHICH}</p>", _picture(draw_ranking(found))]
    if report["parameters"]:
        parts.append(parameter_table(report["parameters"]))
    parts += ["<h2>How far it shrinks</h2>", f"<p>{_shrinkage(found)}</p>"]
    parts += [f"<p>{html.escape(_further(found))}</p>"]
    parts += ["<h2>Measured, nominal and explained</h2>", f"<p>{_TRIALS}</p>"]
    parts.append(_picture(draw_trials(found)))
    if found.hidden:
        parts += ["<h2>What could hide</h2>", f"<p>{_HIDDEN}</p>", hidden_table(found.hidden)]
    parts += ["<h2>What cannot be told</h2>", _list(_limits(report))]
    parts += ["<h2>How good the replay is</h2>", _list(_replay(found))]
    body = "\n".join(parts)
    return (
        '<!doctype html><html lang="en"><head><meta charset="utf-8"><title>Gap report</title>'
        f"<style>{_STYLE}</style></head><body>{body}</body></html>\n"
    )


def _list(lines: Iterable[str]) -> str:
    return "<ul>" + "".join(f"<li>{html.escape(line)}</li>" for line in lines) + "</ul>"


def _further(found: Diagnosis) -> str:
    """What one more effect would bring."""
    first = list(found.further.items())[:3]
    if not first:
        return ""
    named = ", ".join(f"{name} to {gap:.3f}" for name, gap in first)
    here = found.verdict.best.fit.gap
    return f"One more effect would bring what is left, {here:.3f} on the trials of the fit: {named}."


def _replay(found: Diagnosis) -> list[str]:
    lines = [
        f"{sensor}: noise {found.noise[sensor]:.3g}; half the step and twice the elements change the "
        f"replay by {error:.3f} of it"
        for sensor, error in found.replay_error.items()
    ]
    base = found.noise["base_angle_deg"]
    return [*lines, f"base_angle_deg: noise {base:.3g}, taken off as far as the motion allows"]


def _shrinkage(found: Diagnosis) -> str:
    gap = found.gap
    return (
        f"On trials that the fit has not seen the residual falls from {gap.before:.2f} to "
        f"{gap.after:.3f} in units of noise: {100 * gap.shrink:.1f} % "
        f"(95 % interval {100 * gap.shrink_low:.1f} to {100 * gap.shrink_high:.1f} %). "
        "1 is the noise floor."
    )


def _limits(report: dict[str, Any]) -> list[str]:
    advice = report["next_experiment"]
    lines = [*report["cannot_tell"], *([f"Next: {advice}"] if advice else [])]
    return lines or ["Every effect of the library would show in these trials."]


def _picture(figure: Figure) -> str:
    buffer = io.BytesIO()
    figure.savefig(buffer, dpi=90, format="png")
    plt.close(figure)
    return f'<img alt="" src="data:image/png;base64,{base64.b64encode(buffer.getvalue()).decode()}">'
