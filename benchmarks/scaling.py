"""How cost grows: with elements, the step, the number of simulations, the rows of a log.

Elements and step: CPU time of the 8 s turn in viscous tissue, and the error of its tip against the
closed form. Simulations: CPU time of each of so many insertions that differ, with their models, by
`sim.batch.simulate_each` on one thread, and by how much the process grew for each. Rows: CPU time of one
replay of a log by its nominal rig, whose trials come once, twice, four times.
"""

import math
import resource
import sys
from collections.abc import Sequence
from functools import partial
from pathlib import Path
from typing import Any

from benchmarks import report
from benchmarks.batches import campaign
from benchmarks.diagnosis import SHORT, SINGLE, write_log
from benchmarks.methods import rollout_of, setup_of
from benchmarks.rivals import exact_tip_deg
from benchmarks.tissues import END_S, SMOOTH
from benchmarks.work_precision import error_deg
from diagnosis.log.rig_log import read_rig_log
from diagnosis.prepare.prepare import prepare
from diagnosis.replay.replay import replay
from sim.batch import simulate_each
from sim.discretisation import Arrangement
from sim.simulation import prepare_processes
from studies.campaign.cases import cases_of

ELEMENTS = (8, 16, 32, 64, 128)
STEPS_MS = (40.0, 20.0, 10.0, 5.0, 2.5)
SIMULATIONS = (1, 4, 16, 64)
TIMES_OVER = (1, 2, 4)
_UNIT = 1 if sys.platform == "darwin" else 1024  # of ru_maxrss, bytes
_TURNS = 7


def _turns(settings: Sequence[dict[str, Any]]) -> list[tuple[float, float]]:
    """CPU time, s, and error of the tip, deg, of the turn at each setting."""
    runs = {i: rollout_of(setup_of(SMOOTH, **how)) for i, how in enumerate(settings)}
    least = report.least_times_s(runs, turns=_TURNS)
    return [(least[i], error_deg(run(), exact_tip_deg)) for i, run in runs.items()]


def elements() -> list[dict[str, Any]]:
    """Cost of a step, and error, by number of elements and arrangement."""
    settings = [{"elements": n, "arrangement": a} for a in Arrangement for n in ELEMENTS]
    steps = round(END_S / setup_of(SMOOTH).discretisation.step_s)
    return [
        {"arrangement": str(how["arrangement"]), "n": how["elements"], "us a step": 1e6 * cpu / steps}
        | {"tip error, deg": error}
        for how, (cpu, error) in zip(settings, _turns(settings), strict=True)
    ]


def steps() -> list[dict[str, Any]]:
    """Cost of the turn, and error, by step."""
    settings = [{"step_s": 1e-3 * ms} for ms in STEPS_MS]
    return [
        {"step, ms": ms, "ms a turn": 1e3 * cpu, "tip error, deg": error}
        for ms, (cpu, error) in zip(STEPS_MS, _turns(settings), strict=True)
    ]


def simulations() -> list[dict[str, Any]]:
    """Cost and memory of each of so many insertions at once."""
    whole = campaign().but(samples=max(SIMULATIONS))
    every = [case.protocol for case in cases_of(whole, range(max(SIMULATIONS))) if case.protocol]
    rows = []
    for count in SIMULATIONS:
        task = partial(simulate_each, every[:count], threads=1)
        before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
        cpu = report.least_times_s({"all": task}, turns=3, enough_s=1.5)["all"]
        grown = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before
        rows.append({"at once": count, "ms each": 1e3 * cpu / count, "grew, MiB": grown * _UNIT / 2**20})
    return rows


def log_rows(folder: Path) -> list[dict[str, Any]]:
    """Cost of a replay by rows of the log."""
    rows = []
    for times in TIMES_OVER:
        log = read_rig_log(write_log(folder / f"rows-{times}", SHORT, SINGLE, times))
        count = sum(len(trial.table) for trial in log.trials)
        ready = prepare(log)[0]
        cpu = report.least_times_s({"replay": partial(replay, ready)}, turns=5)["replay"]
        rows.append({"rows": count, "ms a replay": 1e3 * cpu, "us a row": 1e6 * cpu / count})
    return rows


def run(folder: Path) -> list[report.Goal]:
    """Measure, print, write."""
    prepare_processes()
    tables = {
        "elements": elements(),
        "step": steps(),
        "simulations": simulations(),
        "rows of a log": log_rows(folder / "scaling-logs"),
    }
    for name, rows in tables.items():
        report.show(f"Cost by {name}", rows, folder, f"scaling_{name.replace(' ', '_')}")
    return [
        *(
            _goal(f"{r['arrangement']}, n = {r['n']}", r["us a step"], "us a step", r)
            for r in tables["elements"]
        ),
        *(
            _goal(f"step of {r['step, ms']:g} ms", r["ms a turn"], "ms a turn", r)
            for r in tables["step"]
        ),
        *(
            _goal(f"{r['at once']} insertions at once", r["ms each"], "ms each", r)
            for r in tables["simulations"]
        ),
        *(
            _goal(f"a log of {r['rows']} rows", r["us a row"], "us a row", r)
            for r in tables["rows of a log"]
        ),
        _goal(
            f"memory of {SIMULATIONS[-1]} insertions", tables["simulations"][-1]["grew, MiB"], "MiB", {}
        ),
    ]


def _goal(name: str, measured: float, unit: str, row: dict[str, Any]) -> report.Goal:
    error = row.get("tip error, deg", math.nan)
    accuracy = "-" if math.isnan(error) else f"tip within {error:.2g} deg"
    return report.Goal(name=name, measured=measured, unit=unit, accuracy=accuracy)


if __name__ == "__main__":
    folder_ = report.out_folder(report.parser(__doc__))
    report.show_goals(run(folder_), folder_)
