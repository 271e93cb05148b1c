"""Work-precision diagrams of one run, for the simulator and for other methods.

The run is `studies.crosscheck.motion.fast_turn`: a needle 20 cm deep, its base turned by
90 deg in 0.3 s and held, 8 s in all, in three tissues. Every method runs at several
steps or tolerances and numbers of elements. Its error is the largest of the tip, deg,
at the times at which it answers, against the closed form (viscous tissue) or LSODA at
tight tolerance on two grids, extrapolated. Work is CPU time: of `Batch.rollout` for the
simulator, without the compilation of its model; of the solver's call for the others.
The table is read off each method's front of best points, straight between them in
logarithms.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
from numpy.typing import NDArray

from benchmarks import report
from benchmarks.methods import (
    BDF,
    EULER,
    KERNEL,
    LSODA,
    LSODA_NUMPY,
    MODES,
    ODEINT,
    OURS,
    RADAU,
    TRAPEZE,
    Answer,
    all_settings,
    rollout_of,
    setup_of,
)
from benchmarks.rivals import converged_tip_deg, exact_tip_deg
from benchmarks.tissues import CASES, END_S, SMOOTH, Case
from sim.discretisation import Arrangement

Array = NDArray[np.float64]
Reference = Callable[[Array], Array]
TARGETS_DEG = (0.05, 0.02, 0.01)
RIVALS = (ODEINT, LSODA, LSODA_NUMPY, BDF, RADAU)
LIMITS = (KERNEL, TRAPEZE, EULER, MODES)
"""What does without MuJoCo, or for one case alone: how near one can come."""
_TURNS = 7


@dataclass(frozen=True, kw_only=True)
class Point:
    """One method at one setting: its error and its work."""

    case: str
    method: str
    setting: str
    error_deg: float
    cpu_ms: float


def reference_of(case: Case) -> tuple[Reference, float]:
    """The tip at any times, deg, and by how much two grids of the reference differ."""
    if case is SMOOTH:
        return exact_tip_deg, 0.0
    time, tip, difference = converged_tip_deg(case)
    return lambda at: np.interp(at, time, tip), difference


def error_deg(answer: Answer, reference: Reference) -> float:
    """Largest error of the tip within the 8 s; infinite where a method lost its way."""
    time, tip = answer
    within = time <= END_S + 1e-9
    error = float(np.abs(tip[within] - reference(time[within])).max())
    return error if math.isfinite(error) else math.inf


def measure(case: Case, reference: Reference) -> list[Point]:
    """Every method at every setting, in turns."""
    settings = all_settings(case)
    errors = {key: error_deg(task(), reference) for key, task in settings.items()}
    useful = {key: settings[key] for key, error in errors.items() if error < 1.0}
    least = report.least_times_s(useful, turns=_TURNS)
    return [
        Point(case=case.name, method=m, setting=s, error_deg=errors[m, s], cpu_ms=1e3 * least[m, s])
        for m, s in useful
    ]


def front(points: list[Point]) -> list[Point]:
    """Points that no other beats in error and work, by falling error."""
    best: list[Point] = []
    for point in sorted(points, key=lambda p: (p.cpu_ms, p.error_deg)):
        if not best or point.error_deg < best[-1].error_deg:
            best.append(point)
    return best


def work_at_ms(points: list[Point], error: float) -> float:
    """CPU time at an error, ms; NaN where no point is as good."""
    best = front(points)
    for i, point in enumerate(best):
        if point.error_deg <= error:
            if i == 0:
                return point.cpu_ms
            worse = best[i - 1]
            share = math.log(worse.error_deg / error) / math.log(worse.error_deg / point.error_deg)
            return worse.cpu_ms * (point.cpu_ms / worse.cpu_ms) ** share
    return math.nan


def _table(points: list[Point]) -> dict[str, list[float]]:
    """CPU time at every target, ms, by method."""
    methods = dict.fromkeys(point.method for point in points)
    return {
        m: [work_at_ms([p for p in points if p.method == m], target) for target in TARGETS_DEG]
        for m in methods
    }


def _least(table: dict[str, list[float]], methods: tuple[str, ...]) -> Array:
    return np.nanmin([table[method] for method in methods if method in table], axis=0)


def _agreement(case: Case, reference: Reference, grids: float) -> dict[str, Any]:
    """Our own converged run against the reference."""
    ours = rollout_of(setup_of(case, elements=64, step_s=1e-3, arrangement=Arrangement.SIBLINGS))
    default = rollout_of(setup_of(case))
    return {
        "tissue": case.name,
        "reference": "closed form" if case is SMOOTH else "LSODA, 200 and 400 cells",
        "its grids differ by, deg": grids,
        "ours, n = 64, 1 ms, deg": error_deg(ours(), reference),
        "ours, defaults, deg": error_deg(default(), reference),
    }


def _draw(points: list[Point], folder: Path) -> None:
    figure, axes = plt.subplots(1, len(CASES), figsize=(16, 6), sharey=True, layout="constrained")
    methods = list(dict.fromkeys(point.method for point in points))
    colours = dict(zip(methods, plt.get_cmap("tab20").colors, strict=False))
    for axis, case in zip(axes, CASES, strict=True):
        for method in methods:
            best = front([p for p in points if p.method == method and p.case == case.name])
            if best:
                x, y = [p.error_deg for p in best], [p.cpu_ms for p in best]
                width = 2.5 if method in OURS else 1.0
                axis.loglog(x, y, "o-", ms=3, lw=width, color=colours[method], label=method)
        for target in TARGETS_DEG:
            axis.axvline(target, color="0.85", lw=1, zorder=0)
        axis.set(xlabel="largest tip error, deg", title=f"8 s in {case.name}", xlim=(1e-3, 1.0))
    axes[0].set_ylabel("CPU time, ms")
    axes[0].legend(fontsize=8)
    report.save(figure, folder, "work_precision")


def _goals(tables: dict[str, dict[str, list[float]]]) -> list[report.Goal]:
    """By tissue and rival: its time over ours at the smallest of the errors; limits the other way."""
    return [
        report.Goal(
            name=f"{case}: {rival}",
            measured=_over_ours(table, rival),
            bound=1.0 if rival in RIVALS else math.nan,
            at_least=True,
            accuracy=f"tip within {TARGETS_DEG[-1]:g} deg",
        )
        for case, table in tables.items()
        for rival in (*RIVALS, *LIMITS)
        if rival in table
    ]


def _over_ours(table: dict[str, list[float]], rival: str) -> float:
    return float(table[rival][-1] / _least(table, OURS)[-1])


def _ratios(tables: dict[str, dict[str, list[float]]]) -> list[dict[str, Any]]:
    """Our time over that of others, at equal error."""
    groups = {
        "LSODA, odeint": (ODEINT,),
        "LSODA, solve_ivp": (LSODA,),
        "LSODA, law in NumPy": (LSODA_NUMPY,),
        "BDF or Radau": (BDF, RADAU),
        "our kernel alone": (KERNEL,),
    }
    return [
        {"tissue": case, "ours over": name}
        | {
            f"at {target:g} deg": float(ratio)
            for target, ratio in zip(
                TARGETS_DEG, _least(table, OURS) / _least(table, rivals), strict=True
            )
        }
        for case, table in tables.items()
        for name, rivals in groups.items()
    ]


def run(folder: Path) -> list[report.Goal]:
    """Measure, print, write."""
    points: list[Point] = []
    agreement = []
    for case in CASES:
        reference, grids = reference_of(case)
        agreement.append(_agreement(case, reference, grids))
        points += measure(case, reference)
    tables = {case.name: _table([p for p in points if p.case == case.name]) for case in CASES}
    rows = [
        {"tissue": case, "method": method}
        | {f"ms at {target:g} deg": ms for target, ms in zip(TARGETS_DEG, work, strict=True)}
        for case, table in tables.items()
        for method, work in table.items()
    ]
    report.show("The references against our own converged run", agreement, folder, "references")
    report.show("CPU time of the 8 s run at equal tip error", rows, folder, "work_precision")
    report.show("Our CPU time over that of others", _ratios(tables), folder, "work_ratios")
    report.write_csv([vars(point) for point in points], folder, "work_precision_points")
    _draw(points, folder)
    return _goals(tables)


if __name__ == "__main__":
    folder_ = report.out_folder(report.parser(__doc__))
    report.show_goals(run(folder_), folder_)
