"""The cross-check as files: `validate.json`, CSV tables and a picture."""

import json
from dataclasses import asdict
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes

from sim.files import refuse_existing, write_text, writing
from sim.simulation import simulate
from studies.crosscheck import motion, paper, paper_text, poles
from studies.crosscheck.findings import Findings
from studies.crosscheck.linear import linear_checks

FILES = ("validate.json", "poles.csv", "checks.csv", "published.csv", "validate.png")


def cross_check() -> Findings:
    """Run every check; about ten seconds."""
    measured = poles.compare_poles()
    return Findings(
        poles=measured,
        checks=[
            poles.check_poles(measured),
            *poles.order_in_elements(),
            motion.order_in_step(),
            *motion.check_fast_turn(),
            motion.check_arrangements(),
            *motion.check_steady_twist(),
            *motion.check_balances(),
            *linear_checks(),
        ],
        comparisons=[*paper.compare_all(), *paper_text.compare_text()],
    )


def write_report(findings: Findings, folder: Path, *, force: bool = False) -> list[Path]:
    """Write every file of the report; returns their paths.

    Raises:
      OutputExists: one of them exists and `force` is not given.
    """
    paths = [folder / name for name in FILES]
    refuse_existing(paths, force=force)
    write_text(paths[0], json.dumps(findings.as_json(), indent=1, allow_nan=False), force=force)
    tables = (
        [asdict(p) | {"error": p.error} for p in findings.poles],
        findings.as_json()["checks"],
        [asdict(c) | {"ratio": c.ratio} for c in findings.comparisons],
    )
    for path, rows in zip(paths[1:4], tables, strict=True):
        write_text(path, pd.DataFrame(rows).to_csv(index=False), force=force)
    _draw(findings, paths[4], force=force)
    return paths


def _draw(findings: Findings, path: Path, *, force: bool) -> None:
    figure, axes = plt.subplots(2, 2, figsize=(14, 9), layout="constrained")
    _draw_poles(axes[0, 0], findings)
    _draw_turn(axes[0, 1])
    _draw_steps(axes[1, 0])
    _draw_ratios(axes[1, 1], findings)
    with writing(path, force=force) as part:
        figure.savefig(part, dpi=130, format="png")
    plt.close(figure)


def _draw_poles(axis: Axes, findings: Findings) -> None:
    for (length, free, drive), group in pd.DataFrame(
        [asdict(p) | {"error": p.error} for p in findings.poles]
    ).groupby(["length_mm", "free_mm", "drive"]):
        label = f"{length:g} mm, {free:g} free, {drive}"
        axis.plot(group["mode"], 100 * group["error"], "o-", ms=4, lw=1, label=label)
    axis.axhline(100 * poles.BOUND, color="k", ls="--", lw=1)
    axis.set(xlabel="mode", ylabel="error, %", yscale="log", xticks=range(1, poles.COUNT + 1))
    axis.set_title("Poles measured from MuJoCo: error (dashed: bound)")
    axis.legend(fontsize=6, ncols=2)


def _draw_turn(axis: Axes) -> None:
    run = simulate([motion.viscous_setup()], motion.fast_turn())[0]
    axis.plot(run.time_s, run.inputs.drive, color="0.5", label="base")
    axis.plot(
        run.time_s, motion.exact_tip_deg(run), color="tab:green", lw=4, alpha=0.4, label="closed form"
    )
    axis.plot(run.time_s, run.tip_deg, color="tab:red", lw=1, label="tip, MuJoCo")
    axis.set(xlabel="time, s", ylabel="angle, deg", title="Fast turn of a needle 20 cm deep")
    axis.legend()


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
    axis.barh(range(len(shown)), ratios, color="tab:blue")
    axis.axvline(1.0, color="k", lw=1)
    axis.set_yticks(range(len(shown)), [c.item for c in shown], fontsize=5)
    axis.invert_yaxis()
    axis.set(xlabel="ours / published", title="Published figures, recomputed")
