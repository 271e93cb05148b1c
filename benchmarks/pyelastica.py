"""The 8 s turn in PyElastica, whose rods can twist too, beside ours.

The same needle at its true density in 16 elements each (`benchmarks.elastica_rod` has
the set-up). The cost of the whole run is that of a step, at the largest step that is
stable, times the number of steps; ours is `Batch.rollout` at the defaults.

PyElastica also bends, shears and stretches, and that sets its step: an exactly straight
rod that nothing disturbs only twists, and then takes steps thousands of times as long.
That row is shown too; the goal is held to a rod that is disturbed, as any needle is.

PyElastica is looked for in the interpreter that `--elastica-python` or the environment
variable ELASTICA_PYTHON names, and in this one otherwise.
"""

import argparse
import json
import math
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import numpy as np

from benchmarks import report
from benchmarks.methods import rollout_of, setup_of
from benchmarks.rivals import exact_tip_deg
from benchmarks.tissues import DAMPING, END_S, LENGTH_MM, SMOOTH, TURN_RAD, TURN_S
from models import units
from models.needle import NITINOL

RATIO_BOUND = 10_000.0
_ELEMENTS = 16
_ROD = Path(__file__).with_name("elastica_rod.py")
_GOAL = "PyElastica's cost of the 8 s turn over ours"


def add_option(parser: argparse.ArgumentParser) -> None:
    """`--elastica-python`."""
    default = os.environ.get("ELASTICA_PYTHON", sys.executable)
    parser.add_argument("--elastica-python", default=default, help="interpreter that has PyElastica")


def _rig() -> dict[str, float]:
    return {
        "length": LENGTH_MM * units.MM,
        "radius": NITINOL.radius_mm * units.MM,
        "density": NITINOL.density_g_cm3 * units.G_PER_CM3,
        "shear_modulus": NITINOL.shear_modulus_gpa * 1e9,
        "damping": DAMPING,  # the same number in N m s / rad / m
        "turn_rad": TURN_RAD,
        "turn_s": TURN_S,
        "end_s": END_S,
        "elements": _ELEMENTS,
    }


def _missing(python: str) -> str:
    """Why PyElastica cannot be measured; empty if it can."""
    try:
        tried = subprocess.run([python, "-c", "import elastica"], capture_output=True, check=False)
    except OSError as error:
        return f"{python} does not start: {error}"
    if tried.returncode == 0:
        return ""
    return (
        f"{python} cannot import elastica; `pip install pyelastica` in an environment of its own "
        "and name its interpreter with --elastica-python or ELASTICA_PYTHON"
    )


def _measured(python: str) -> dict[str, Any]:
    command = [python, "-P", "-W", "ignore", str(_ROD)]
    done = subprocess.run(command, input=json.dumps(_rig()), capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise RuntimeError(f"{' '.join(command)} failed: {done.stderr[-2000:]}")
    found: dict[str, Any] = json.loads(done.stdout.splitlines()[-1])
    return found


def _rows(found: dict[str, Any], ours_s: float) -> list[dict[str, Any]]:
    kinds = [
        ("drag as external torque, disturbed", found["torque"]),
        ("implicit drag of our own, disturbed", found["damper"]),
        *(("implicit drag, exactly straight", run) for run in found["undisturbed"]),
    ]
    rows = []
    for name, run in kinds:
        total = END_S / run["step_s"] * run["cpu_a_step_s"]
        error = math.nan
        if "tip_rad" in run:
            exact = exact_tip_deg(np.array(run["time_s"]))
            error = float(np.abs(np.degrees(run["tip_rad"]) - exact).max())
        rows.append(
            {
                "PyElastica " + found["version"]: name,
                "step, us": 1e6 * run["step_s"],
                "CPU a step, us": 1e6 * run["cpu_a_step_s"],
                "CPU of 8 s, s": total,
                "over ours": total / ours_s,
                "tip error, deg": error,
            }
        )
    return rows


def _draw(rows: list[dict[str, Any]], ours_s: float, folder: Path) -> None:
    figure, axis = plt.subplots(figsize=(9, 3), layout="constrained")
    names = [f"{next(iter(row.values()))}, {row['step, us']:g} us" for row in rows]
    axis.barh(["ours, defaults", *names], [ours_s, *(row["CPU of 8 s, s"] for row in rows)])
    axis.invert_yaxis()
    axis.set(xscale="log", xlabel="CPU time of the 8 s turn, s", title="PyElastica beside ours")
    report.save(figure, folder, "pyelastica")


def run(folder: Path, python: str) -> list[report.Goal]:
    """Measure, print, write; or say why not."""
    missing = _missing(python)
    if missing:
        report.say(f"PyElastica: skipped. {missing}")
        return [report.Goal(name=_GOAL, measured=math.nan, bound=RATIO_BOUND, at_least=True)]
    found = _measured(python)
    ours_s = report.least_times_s({"ours": rollout_of(setup_of(SMOOTH))}, turns=50)["ours"]
    rows = _rows(found, ours_s)
    title = f"The 8 s turn in PyElastica; ours, at the defaults: {1e3 * ours_s:.2f} ms"
    report.show(title, rows, folder, "pyelastica")
    _draw(rows, ours_s, folder)
    return [
        report.Goal(
            name=_GOAL,
            measured=rows[1]["over ours"],
            bound=RATIO_BOUND,
            at_least=True,
            accuracy="16 elements each",
        )
    ]


if __name__ == "__main__":
    parser_ = report.parser(__doc__)
    add_option(parser_)
    options = parser_.parse_args()
    report.show_goals(run(Path(options.out), options.elastica_python), Path(options.out))
