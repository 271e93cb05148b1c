"""The cross-check as files: `validate.json`, CSV tables, a picture and recordings."""

import json
from collections.abc import Callable, Sequence
from dataclasses import asdict
from functools import partial
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes

from sim.files import Destination, ResultSet, publishing, write_text
from studies.crosscheck import motion, paper, paper_text, poles, recordings, turn
from studies.crosscheck.findings import Check, Findings, PoleSource
from studies.crosscheck.linear import linear_checks

FILES = (
    *("validate.json", "poles.csv", "checks.csv", "published.csv", "validate.png"),
    *recordings.NAMES,
)
_Check = Callable[[], Sequence[Check]]
_CHECKS: tuple[tuple[str, float, _Check], ...] = (
    ("convergence in elements and step", 0.42, poles.order_in_elements),
    ("convergence in elements and step", 0.42, motion.order_in_step),
    ("fast turn", 0.44, turn.check_fast_turn),
    ("fast turn", 0.66, lambda: [motion.check_first_order_turn(), motion.check_arrangements()]),
    ("steady twist and balances", 0.69, motion.check_steady_twist),
    ("steady twist and balances", 0.7, motion.check_balances),
    ("linear model", 0.72, linear_checks),
)
"""Beside the poles: in words, and the share of the time that has usually passed before each."""
_CHECKED = 0.92
_RATIOS = (0.05, 20.0)  # of our figure over the published one, that are drawn
_MARKERS = {
    PoleSource.SECOND_ORDER: ("tab:red", "o"),
    PoleSource.FIRST_ORDER: ("tab:orange", "^"),
    PoleSource.NATIVE: ("tab:purple", "s"),
}
_LINES = {8: ("o", "-"), 16: ("s", "--"), 32: ("^", ":")}
"""Of a needle of so many elements; told apart in grey, too."""


def cross_check(progress: Callable[[str, float], None] = lambda what, share: None) -> Findings:
    """Run every check; about ten seconds.

    Args:
      progress: called with the check that begins, and the share of the time that has usually passed.
    """
    progress("poles", 0.0)
    measured = poles.compare_poles()
    checks = list(poles.check_poles(measured))
    for what, share, check in _CHECKS:
        progress(what, share)
        checks += check()
    progress("published figures", _CHECKED)
    comparisons = [*paper.compare_all(), *paper_text.compare_text()]
    return Findings(poles=measured, checks=checks, comparisons=comparisons)


def write_report(findings: Findings, destination: Destination) -> ResultSet:
    """Write all files of the report as one set; a picture or recording that fails is left out.

    Raises:
      OutputExists, UnsafeOutput, UnwritableOutput: nothing is written.
    """
    paths = output_paths(destination.folder)
    with publishing(destination, paths) as results:
        told, *tables, picture = paths[:5]
        write_text(results.at(told), json.dumps(findings.as_json(), indent=1, allow_nan=False))
        for path, rows in zip(tables, _tables(findings), strict=True):
            write_text(results.at(path), pd.DataFrame(rows).to_csv(index=False))
        results.optional(picture, partial(_draw, findings))
        recordings.write_recordings(results, destination.folder)
    return results


def output_paths(folder: Path) -> list[Path]:
    """All files that `write_report` writes."""
    return [folder / name for name in FILES]


def _tables(findings: Findings) -> tuple[list[dict[str, Any]], ...]:
    """Poles, checks, published figures."""
    return (
        [asdict(p) | {"error": p.error} for p in findings.poles],
        findings.as_json()["checks"],
        [asdict(c) | {"ratio": c.ratio} for c in findings.comparisons],
    )


def _draw(findings: Findings, path: Path) -> None:
    # Poles, turn, its differences and steps one below the other, ratios beside all of them.
    figure, axes = plt.subplot_mosaic("PR;TR;DR;SR", figsize=(15, 14), layout="constrained")
    _draw_poles(axes["P"], findings)
    _draw_turn(axes["T"], axes["D"])
    _draw_steps(axes["S"])
    _draw_ratios(axes["R"], findings)
    figure.savefig(path, dpi=110, format="png", facecolor="white")
    plt.close(figure)


def _draw_poles(axis: Axes, findings: Findings) -> None:
    """Draw the errors of every case and the bound of each source, side by side for each mode."""
    beside = np.linspace(-0.25, 0.25, len(_MARKERS))
    for shift, (source, (colour, marker)) in zip(beside, _MARKERS.items(), strict=True):
        found = [p for p in findings.poles if p.source is source]
        modes = np.array([p.mode for p in found]) + shift
        errors = [100 * p.error for p in found]
        axis.plot(modes, errors, marker, ms=5, mfc="none", color=colour, label=source.words)
        bound = 100 * poles.SOURCES[source].bound
        slots = np.arange(1, poles.COUNT + 1) + shift
        levels = np.full(slots.size, bound)
        axis.hlines(levels, slots - 0.11, slots + 0.11, color=colour, lw=3)
    axis.set(xlabel="mode", ylabel="error, %", yscale="log", xticks=range(1, poles.COUNT + 1))
    axis.set_title("Poles measured from MuJoCo: a mark per case, a bar at the bound")
    axis.legend(loc="lower right")


def _draw_turn(axis: Axes, differences: Axes) -> None:
    """Draw base and tip; below, the differences of both needles' tips from the closed form."""
    shown = turn.turned(turn.FREE_MM[0])
    run, native, exact = shown.run, shown.native_tip_deg, shown.exact_tip_deg
    axis.plot(run.time_s, run.inputs.drive, color="0.5", ls="--", label="base")
    axis.plot(run.time_s, exact, color="k", label="tip, closed form")
    axis.set(ylabel="angle, deg", title="Fast turn of a needle 20 cm deep")
    axis.legend(loc="center right")
    differences.plot(run.time_s, run.tip_deg - exact, color="tab:red", label="our needle")
    differences.plot(
        run.time_s, native - exact, color="tab:purple", ls=":", lw=2, label="needle without callbacks"
    )
    differences.set(xlabel="time, s", ylabel="deg", title="Tip minus closed form")
    differences.legend(loc="upper right")


def _draw_steps(axis: Axes) -> None:
    steps = np.array([0.08, 0.04, 0.02, 0.01, 0.005])
    for elements, (marker, line) in _LINES.items():
        errors = [
            motion.tip_error_deg(motion.viscous_setup(elements=elements, step_s=h), motion.fast_turn())
            for h in steps
        ]
        style = {"marker": marker, "ls": line, "ms": 4 + elements / 4, "mfc": "none"}
        axis.loglog(1e3 * steps, errors, label=f"{elements} elements", **style)
    axis.loglog(1e3 * steps, 2e-5 * (1e3 * steps) ** 2, "0.6", lw=3, zorder=0, label="second order")
    axis.set(xlabel="step, ms", ylabel="largest tip error, deg", title="Error against the step")
    axis.set_xticks(1e3 * steps, [f"{1e3 * h:g}" for h in steps], minor=False)
    axis.minorticks_off()
    axis.legend()


def _draw_ratios(axis: Axes, findings: Findings) -> None:
    shown = [c for c in findings.comparisons if "mode" not in c.item or "inertialess" in c.item]
    ratios = np.array([c.ratio for c in shown])
    rows = np.arange(len(shown))
    axis.axvline(1.0, color="k", lw=1)
    axis.plot(ratios, rows, "o", color="tab:blue", ms=5)
    for row in rows[np.isnan(ratios)]:
        axis.annotate("ours never settles", (1.1 * _RATIOS[0], row), va="center", fontsize=8)
    below = rows[ratios < _RATIOS[0]]
    axis.plot(np.full(below.size, 1.1 * _RATIOS[0]), below, "<", color="tab:blue", ms=6)
    axis.set_yticks(rows, [c.item for c in shown], fontsize=8)
    axis.invert_yaxis()
    axis.grid(axis="y", color="0.9")
    axis.set(xscale="log", xlim=_RATIOS)
    axis.set_xlabel("ours / published (arrow: off the scale)")
    axis.set_title("Published figures, recomputed")
