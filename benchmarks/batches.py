"""Many insertions at once: the speed-up by a second thread, and the overhead of a campaign.

`sim.batch.simulate_each` runs insertions that differ in tissue, turn and depth alternately on one thread
and on two, in wall time: the ratio of the least times is the speed-up. It needs two idle cores, and many
short turns, because other users of the same processor slow down one core or the other for seconds; the
load of the machine is printed. The overhead of a campaign (drawing values, rows, files) is measured on
one process, as CPU time, together with that of its insertions in the same run.
"""

import os
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks import report
from diagnosis.engines.local import on_this_machine
from sim.batch import simulate_each
from sim.paper_protocols import protocol_named
from sim.simulation import prepare_processes
from studies.campaign import run_case
from studies.campaign.campaign import Campaign, Kind
from studies.campaign.cases import cases_of
from studies.campaign.results import ResultFolder
from studies.campaign.run import run_campaign
from studies.campaign.variation import Variation

SPEED_UP_BOUND = 1.8  # on two cores
OVERHEAD_BOUND = 5.0  # percent
_PARTS = ("insertions", "what a campaign does beside them")
_INSERTIONS = 64
_TURNS = 3
_SHORT = 32  # insertions of a turn: both cores are rarely undisturbed for long
_GAIN_TURNS = 50


def campaign() -> Campaign:
    """Insertions of 9.3 s that differ in tissue, turn and depth."""
    return Campaign(
        name="benchmark",
        kind=Kind.INSERTION,
        base=protocol_named("fig5-10cm"),
        vary={
            "tissue.layers.0.interface.viscous_n_mm_s_per_mm": Variation(uniform=(0.01, 0.03)),
            "segments.1.turn_deg": Variation(normal=(90.0, 3.0)),
            "inserted_mm": Variation(uniform=(80.0, 120.0)),
        },
        samples=_INSERTIONS,
        cases_per_piece=_INSERTIONS,
    )


def _least_wall_times_s(tasks: dict[str, Callable[[], object]]) -> dict[str, float]:
    """Least wall time of each task; they take turns."""
    least = dict.fromkeys(tasks, float("inf"))
    for _ in range(_GAIN_TURNS):
        for name, task in tasks.items():
            start = time.perf_counter()
            task()
            least[name] = min(least[name], time.perf_counter() - start)
    return least


def _overhead(whole: Campaign) -> tuple[float, float]:
    """CPU time of a campaign's insertions, and of all that it does beside them, s, in one run."""
    inside = 0.0

    def timed(*given: Any, **how: Any) -> Any:
        nonlocal inside
        began = time.process_time()
        found = simulate_each(*given, **how)
        inside += time.process_time() - began
        return found

    run_case.simulate_each, usual = timed, run_case.simulate_each
    began = time.process_time()
    try:
        with tempfile.TemporaryDirectory() as kept:
            results = ResultFolder(folder=Path(kept), campaign=whole)
            run_campaign(results, on_this_machine(1), force=True, progress=lambda _: None)
    finally:
        run_case.simulate_each = usual
    return inside, time.process_time() - began - inside


def run(folder: Path) -> list[report.Goal]:
    """Measure, print, write."""
    prepare_processes()
    whole = campaign()
    protocols = [case.protocol for case in cases_of(whole, range(_SHORT)) if case.protocol]
    wall = _least_wall_times_s(
        {
            "1 thread": lambda: simulate_each(protocols, threads=1),
            "2 threads": lambda: simulate_each(protocols, threads=2),
        }
    )
    shares = [_overhead(whole) for _ in range(_TURNS)]
    rows = [
        {"what": name, "clock": clock, "ms an insertion": 1e3 * seconds / count}
        for clock, count, times in (
            ("wall", _SHORT, wall),
            ("CPU", _INSERTIONS, dict(zip(_PARTS, min(shares, key=sum), strict=True))),
        )
        for name, seconds in times.items()
    ]
    load = os.getloadavg()[0] if hasattr(os, "getloadavg") else float("nan")
    title = f"Insertions of 9.3 s; {os.cpu_count()} cores, load {load:.1f}"
    report.show(title, rows, folder, "batches")
    overhead = 100 * float(np.median([beside / inside for inside, beside in shares]))
    gain = wall["1 thread"] / wall["2 threads"]
    return [
        report.Goal(
            name="insertions, 2 threads",
            measured=gain,
            bound=SPEED_UP_BOUND,
            at_least=True,
            accuracy=f"the same bits; load {load:.1f}",
        ),
        report.Goal(
            name="campaign over its insertions", measured=overhead, bound=OVERHEAD_BOUND, unit="%"
        ),
    ]


if __name__ == "__main__":
    folder_ = report.out_folder(report.parser(__doc__))
    report.show_goals(run(folder_), folder_)
