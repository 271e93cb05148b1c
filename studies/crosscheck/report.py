"""The cross-check as files: `validate.json`, CSV tables, a picture and recordings."""

import json
from dataclasses import asdict
from functools import partial
from itertools import groupby
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes

from sim.files import Destination, ResultSet, publishing, write_text
from studies.crosscheck import motion, paper, paper_text, poles, recordings, turn
from studies.crosscheck.findings import Findings, PoleSource
from studies.crosscheck.linear import linear_checks

FILES = (
    *("validate.json", "poles.csv", "checks.csv", "published.csv", "validate.png"),
    *recordings.NAMES,
)
_RATIOS = (0.05, 20.0)  # of our figure over the published one, that are drawn
_COLOURS = {
    PoleSource.SECOND_ORDER: "tab:red",
    PoleSource.FIRST_ORDER: "tab:orange",
    PoleSource.NATIVE: "tab:purple",
}


def cross_check() -> Findings:
    """Run every check; about ten seconds."""
    measured = poles.compare_poles()
    return Findings(
        poles=measured,
        checks=[
            *poles.check_poles(measured),
            *poles.order_in_elements(),
            *motion.order_in_step(),
            *turn.check_fast_turn(),
            motion.check_first_order_turn(),
            motion.check_arrangements(),
            *motion.check_steady_twist(),
            *motion.check_balances(),
            *linear_checks(),
        ],
        comparisons=[*paper.compare_all(), *paper_text.compare_text()],
    )


def write_report(findings: Findings, destination: Destination) -> ResultSet:
    """Write every file of the report as one; a picture or recording that fails is left out.

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
    """What `write_report` will write."""
    return [folder / name for name in FILES]


def _tables(findings: Findings) -> tuple[list[dict[str, Any]], ...]:
    """Poles, checks, published figures."""
    return (
        [asdict(p) | {"error": p.error} for p in findings.poles],
        findings.as_json()["checks"],
        [asdict(c) | {"ratio": c.ratio} for c in findings.comparisons],
    )


def _draw(findings: Findings, path: Path) -> None:
    # Poles, turn and steps one below the other, ratios beside all of them.
    figure, axes = plt.subplot_mosaic("PR;TR;SR", figsize=(14, 12), layout="constrained")
    _draw_poles(axes["P"], findings)
    _draw_turn(axes["T"])
    _draw_steps(axes["S"])
    _draw_ratios(axes["R"], findings)
    figure.savefig(path, dpi=130, format="png")
    plt.close(figure)


def _draw_poles(axis: Axes, findings: Findings) -> None:
    """Errors of every case, one colour per source."""
    for source, of_source in groupby(findings.poles, key=lambda p: p.source):
        colour = _COLOURS[source]
        for _, case in groupby(of_source, key=lambda p: (p.length_mm, p.free_mm, p.drive)):
            errors = [100 * p.error for p in case]
            axis.plot(range(1, len(errors) + 1), errors, "o-", ms=3, lw=0.7, color=colour)
        bound = 100 * poles.SOURCES[source].bound
        axis.axhline(bound, color=colour, ls="--", lw=1, label=f"{source.words}, bound")
    axis.set(xlabel="mode", ylabel="error, %", yscale="log", xticks=range(1, poles.COUNT + 1))
    axis.set_title("Poles measured from MuJoCo: error, one line per case")
    axis.legend(loc="lower right")


def _draw_turn(axis: Axes) -> None:
    """The base and three tips; the tips' differences are too small to see, and have an inset."""
    shown = turn.turned(turn.FREE_MM[0])
    run, native, exact = shown.run, shown.native_tip_deg, shown.exact_tip_deg
    axis.plot(run.time_s, run.inputs.drive, color="0.5", label="base")
    axis.plot(run.time_s, exact, color="tab:green", lw=4, alpha=0.4, label="tip, closed form")
    axis.plot(run.time_s, run.tip_deg, color="tab:red", lw=1, label="tip, MuJoCo")
    axis.plot(run.time_s, native, color="tab:purple", ls=":", label="tip, native needle")
    axis.set(xlabel="time, s", ylabel="angle, deg", title="Fast turn of a needle 20 cm deep")
    axis.legend(loc="upper right", bbox_to_anchor=(1, 0.85))
    inset = axis.inset_axes((0.45, 0.12, 0.52, 0.3))
    inset.plot(run.time_s, run.tip_deg - exact, color="tab:red", lw=1)
    inset.plot(run.time_s, native - exact, color="tab:purple", ls=":")
    inset.set_title("minus closed form, deg", fontsize=8)
    inset.tick_params(labelsize=7)


def _draw_steps(axis: Axes) -> None:
    steps = np.array([0.08, 0.04, 0.02, 0.01, 0.005])
    for elements in (8, 16, 32):
        errors = [
            motion.tip_error_deg(motion.viscous_setup(elements=elements, step_s=h), motion.fast_turn())
            for h in steps
        ]
        axis.loglog(1e3 * steps, errors, "o-", ms=4, label=f"{elements} elements")
    axis.loglog(1e3 * steps, 2e-5 * (1e3 * steps) ** 2, "k:", lw=1, label="second order")
    axis.set(xlabel="step, ms", ylabel="largest tip error, deg", title="Error against the step")
    axis.set_xticks(1e3 * steps, [f"{1e3 * h:g}" for h in steps], minor=False)
    axis.minorticks_off()
    axis.legend()


def _draw_ratios(axis: Axes, findings: Findings) -> None:
    shown = [c for c in findings.comparisons if "mode" not in c.item or "inertialess" in c.item]
    ratios = [c.ratio for c in shown]
    axis.plot(ratios, range(len(shown)), "o", color="tab:blue", ms=5)
    axis.axvline(1.0, color="k", lw=1)
    axis.set_yticks(range(len(shown)), [c.item for c in shown], fontsize=7)
    axis.invert_yaxis()
    axis.grid(axis="y", color="0.9")
    axis.set(xscale="log", xlim=_RATIOS)
    axis.set_xlabel(f"ours / published (no mark: ours never settles, or is below {_RATIOS[0]:g})")
    axis.set_title("Published figures, recomputed")
