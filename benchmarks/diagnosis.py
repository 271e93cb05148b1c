"""Computing time of `needle diagnose` by stage, its growth with the length of the log, and its memory.

Logs come from the independent rig of `validation.rig`: five trials of 120 s in all at
100 Hz, with one effect and with a pair of them; and a shorter log once, twice and four
times over, with new noise each time. Reading and report count, the start of Python does not.

Stages are wall-clock time: what passes until a report of progress counts to what it
reports. The unit is one replay of the whole log by the nominal needle. Growth is of the
CPU time of the process and its workers, which other work on the machine changes less. How
many steps a fit takes depends on the noise, too; with this seed it hardly does.

Memory is that of the diagnosis' process and its workers: the peak of the sum of their proportional
set sizes, in which a page that several of them share counts once, looked at every 0.2 s.
"""

import multiprocessing
import resource
import time
from concurrent.futures import Future, ProcessPoolExecutor, wait
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
import psutil

from benchmarks import report
from diagnosis.log.rig_log import read_rig_log
from diagnosis.pipeline import diagnose
from diagnosis.prepare.prepare import prepare
from diagnosis.progress import Progress
from diagnosis.replay.replay import replay
from diagnosis.report.write import write_report
from sim.files import Destination
from sim.simulation import prepare_processes
from validation.logs.comparison import RigComparison
from validation.logs.motions import LogPlan, draw_motions
from validation.logs.rig_draw import draw_rig
from validation.logs.sensors import BASE, TIP, TORQUE, LogSensors, as_csv, measure, rig_yaml
from validation.rig.simulation import ideal_signals

WORKERS = 2
PLAN = LogPlan(trials=5, total_s=120.0, rate_hz=100, sliding=0.4, growing=0.0, loaded=0.0)
SHORT = replace(PLAN, trials=2, total_s=24.0)
SINGLE, PAIR = ("coulomb_friction",), ("coulomb_friction", "chuck_backlash")
TIMES_OVER = (1, 2, 4)
SINGLE_BOUND_S, PAIR_BOUND_S, MEMORY_BOUND_GIB, GROWTH_BOUND = 60.0, 180.0, 1.0, 1.3

_SEED = 6
_TOLD = 0.05  # share of the time from which a stage is in the one table
_SIGNATURE = (4.0, 6.0)  # of each effect: rms of what it changes / sigma
_NOISE = {TIP: 0.4, TORQUE: 0.015, BASE: 0.02}
_SENSORS = LogSensors(noise=_NOISE, claims=dict.fromkeys(_NOISE, 1.0), steps={})
_ONE, _TWO = "one effect", "a pair"
_LOADING, _READING, _REPORT = "loading the callback", "reading", "report"
_BEFORE, _AFTER = "before the search", "after the search"
_LOOK_S = 0.2  # at memory


@dataclass(frozen=True, kw_only=True)
class Cost:
    """Time and memory of one diagnosis.

    Attributes:
      says: its result in words.
      stages_s: wall-clock time by stage, s, in their order.
      cpu_s: of the process and its workers.
      replay_s: CPU time of one replay of the log by the nominal needle.
      peak_gib: largest memory of the process and its workers together.
    """

    trials: int
    says: str
    stages_s: dict[str, float]
    cpu_s: float
    replay_s: float
    peak_gib: float = 0.0

    @property
    def wall_s(self) -> float:
        """Wall-clock time from the log's files to the report's, s."""
        return sum(self.stages_s.values())


class Stages:
    """A stopwatch: the time until a mark counts for the stage of the mark."""

    def __init__(self) -> None:
        self.seconds: dict[str, float] = {}
        self._last = time.perf_counter()

    def mark(self, stage: str) -> None:
        """A stage, or a part of it, is done."""
        now = time.perf_counter()
        self.seconds[stage] = self.seconds.get(stage, 0.0) + now - self._last
        self._last = now

    def heard(self, news: Progress) -> None:
        """Mark a report of progress; the time up to the first one is that before the search."""
        self.mark(news.stage if _BEFORE in self.seconds else _BEFORE)


def write_log(folder: Path, plan: LogPlan, effects: tuple[str, ...], times_over: int = 1) -> Path:
    """Write a log of a rig with these effects; its trials are repeated with new noise.

    Raises:
      ValueError: the trials of the plan cannot show such effects.
    """
    rng = np.random.default_rng(_SEED)
    motions = draw_motions(rng, plan)
    comparison = RigComparison(motions, _SENSORS, coarse=True)
    rig = draw_rig(rng, comparison, "pair" if len(effects) > 1 else "single", effects, _SIGNATURE)
    if rig is None:
        raise ValueError(
            f"effects: expected some that {plan} can show, found {effects}; try another seed"
        )
    folder.mkdir(parents=True, exist_ok=True)
    shown = [(motion, ideal_signals(rig, motion)) for motion in motions] * times_over
    (folder / "rig.yaml").write_text(rig_yaml(_SENSORS, rig, len(shown)))
    for i, (motion, signals) in enumerate(shown):
        table = as_csv(measure(rng, _SENSORS, motion, signals))
        (folder / f"trial_{i + 1:02d}.csv").write_text(table)
    return folder


def cost(folder: Path) -> Cost:
    """Time and memory of the diagnosis of a log, in a process of its own."""
    # A server's child has none of this process's memory, but would have its workers from the server.
    with ProcessPoolExecutor(1, mp_context=multiprocessing.get_context("forkserver")) as alone:
        task = alone.submit(_cost, folder, multiprocessing.get_start_method())
        peak_gib = _peak_gib(task)
        return replace(task.result(), peak_gib=peak_gib)


def _cost(folder: Path, usual: str) -> Cost:
    multiprocessing.set_start_method(usual, force=True)
    stages, start_s = Stages(), used_cpu_s()
    prepare_processes()
    stages.mark(_LOADING)
    log = read_rig_log(folder)
    stages.mark(_READING)
    found = diagnose(log, workers=WORKERS, progress=stages.heard)
    stages.mark(_AFTER)
    write_report(found, Destination(folder=folder / "report", force=True))
    stages.mark(_REPORT)
    cpu_s = used_cpu_s() - start_s

    prepared, _ = prepare(log)

    return Cost(
        trials=len(log.trials),
        says=" + ".join(found.verdict.effects) or found.verdict.kind.value,
        stages_s=stages.seconds,
        cpu_s=cpu_s,
        replay_s=report.least_times_s({"replay": lambda: replay(prepared)}, turns=5)["replay"],
    )


def used_cpu_s() -> float:
    """CPU time of this process and of its workers that have ended, s."""
    used = [resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
    return sum(usage.ru_utime + usage.ru_stime for usage in used)


def _peak_gib(task: Future[Cost]) -> float:
    """The largest memory of this process's children until a task is done."""
    largest = 0
    while wait([task], timeout=_LOOK_S).not_done:
        largest = max(largest, sum(map(_memory_bytes, psutil.Process().children(recursive=True))))
    return largest / 2**30


def _memory_bytes(process: psutil.Process) -> int:
    """Proportional set size, or memory of the process alone where the system does not tell it."""
    try:
        memory = process.memory_full_info()
    except psutil.Error:  # it has just ended
        return 0
    return int(getattr(memory, "pss", memory.uss))


def _stage_rows(name: str, one: Cost) -> list[dict[str, Any]]:
    return [
        {
            "log": name,
            "stage": stage,
            "seconds": seconds,
            "share, %": 100 * seconds / one.wall_s,
            "replays of the log": seconds / one.replay_s,
        }
        for stage, seconds in (one.stages_s | {"whole": one.wall_s}).items()
    ]


def _whole_row(name: str, one: Cost) -> dict[str, Any]:
    return {
        "log": name,
        "trials": one.trials,
        "says": one.says,
        "wall, s": one.wall_s,
        "CPU, s": one.cpu_s,
        "CPU a trial, s": one.cpu_s / one.trials,
        "one replay, s": one.replay_s,
        "CPU, replays": one.cpu_s / one.replay_s,
        "peak, GiB": one.peak_gib,
    }


def _draw(costs: dict[str, Cost], folder: Path) -> None:
    figure, axis = plt.subplots(figsize=(9, 5), layout="constrained")
    stages = max((one.stages_s for one in costs.values()), key=len)  # in their order
    base = np.zeros(len(costs))
    for stage, colour in zip(stages, plt.get_cmap("tab20").colors, strict=False):  # type: ignore[attr-defined]
        height = np.array([one.stages_s.get(stage, 0.0) for one in costs.values()])
        axis.bar(list(costs), height, bottom=base, label=stage, color=colour)
        base += height
    axis.set(ylabel="s", title=f"Where the time of a diagnosis goes, {WORKERS} workers")
    axis.legend()
    report.save(figure, folder, "diagnosis_time")


def _goals(costs: dict[str, Cost], grown: list[Cost]) -> list[report.Goal]:
    a_trial = [one.cpu_s / one.trials for one in grown]
    peak_gib = max(one.peak_gib for one in costs.values())
    wall_s = [costs[name].wall_s for name in (_ONE, _TWO)]
    growth = f"CPU time a trial, {TIMES_OVER[-1]} times as many trials: longest log over the least"
    stages = [
        report.Goal(name=f"of it, {stage}", measured=100 * seconds / costs[_ONE].wall_s, unit="%")
        for stage, seconds in costs[_ONE].stages_s.items()
        if seconds > _TOLD * costs[_ONE].wall_s
    ]
    return [
        report.Goal(name=f"diagnosis of {_ONE}", measured=wall_s[0], bound=SINGLE_BOUND_S, unit="s"),
        *stages,
        report.Goal(name=f"diagnosis of {_TWO}", measured=wall_s[1], bound=PAIR_BOUND_S, unit="s"),
        report.Goal(name=growth, measured=a_trial[-1] / min(a_trial), bound=GROWTH_BOUND),
        report.Goal(name="diagnosis, memory", measured=peak_gib, bound=MEMORY_BOUND_GIB, unit="GiB"),
    ]


def run(folder: Path) -> list[report.Goal]:
    """Measure, print, write."""
    prepare_processes()  # compiled here, if at all: processes of their own load it
    logs = folder / "diagnosis-logs"
    whole = {
        _ONE: cost(write_log(logs / "one", PLAN, SINGLE)),
        _TWO: cost(write_log(logs / "pair", PLAN, PAIR)),
    }
    grown = {f"short, {n} x": cost(write_log(logs / f"short-{n}", SHORT, SINGLE, n)) for n in TIMES_OVER}
    for name, one in whole.items():
        n = one.wall_s / one.replay_s
        report.say(f"{name}: one replay of the log takes {one.replay_s:.3f} s; the diagnosis, {n:.0f}")
    rows = [row for name, one in whole.items() for row in _stage_rows(name, one)]
    report.show("Where the time of a diagnosis goes", rows, folder, "diagnosis_time")
    costs = whole | grown
    rows = [_whole_row(name, one) for name, one in costs.items()]
    report.show(f"Diagnoses, {WORKERS} workers", rows, folder, "diagnosis_cost")
    _draw(costs, folder)
    return _goals(costs, list(grown.values()))


if __name__ == "__main__":
    folder_ = report.out_folder(report.parser(__doc__))
    report.show_goals(run(folder_), folder_)
