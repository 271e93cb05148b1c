"""Every stage of `needle control`, with its independent parts in several processes."""

from collections.abc import Callable
from concurrent.futures import Executor
from functools import partial
from typing import Any

from diagnosis.workers import process_pool
from sim.simulation import prepare_processes
from studies.control.report import ControlStudy
from studies.control.robustness import misjudged_delays, plants, robustness
from studies.control.steering.steering_study import SteeringStudy, steering_parts
from studies.control.tables import tables_iv_v

Part = Callable[[], Any]
Progress = Callable[[str, float], None]

_PERCENT = {
    "Tables IV and V": 17.0,
    "robustness": 55.0,
    "steered insertions": 3.0,
    "the planar controller": 2.0,
    "the planar controller with images": 14.0,
    "base and images fused": 6.0,
    "duty-cycled spinning": 3.0,
}
"""Usual shares of the time; nothing depends on them but the estimate of the time that is left."""


def stage_parts() -> dict[str, list[Part]]:
    """The independent parts of every stage, in order."""
    rigs = (*plants(), *misjudged_delays())
    return {
        "Tables IV and V": [tables_iv_v],
        "robustness": [partial(robustness, rigs=(rig,)) for rig in rigs],
        **steering_parts(),
    }


def run_study(progress: Progress = lambda stage, share: None, *, workers: int = 2) -> ControlStudy:
    """Run everything; about two minutes on two cores.

    Args:
      progress: called with the stage that is awaited, and the share of the whole time that has
        usually passed by then.
      workers: number of processes.
    """
    prepare_processes()
    with process_pool(workers) as processes:
        made = collected(stage_parts(), processes.pool, progress)
    tables, robust, *steering = made.values()
    return ControlStudy(
        tables=tables[0],
        robustness=[response for responses in robust for response in responses],
        steering=SteeringStudy.of_parts(*steering),
    )


def collected(
    stages: dict[str, list[Part]], pool: Executor | None, progress: Progress
) -> dict[str, list[Any]]:
    """Results of the parts of every stage, in order."""
    waiting = {
        stage: [pool.submit(part).result if pool else part for part in parts]
        for stage, parts in stages.items()
    }
    made: dict[str, list[Any]] = {stage: [] for stage in stages}
    for stage, results in waiting.items():
        for done, result in enumerate(results):
            progress(stage, _share(stage, done / len(results)))
            made[stage].append(result())
    return made


def _share(stage: str, of_stage: float) -> float:
    """Share of the whole time that has usually passed when a stage is done to the share `of_stage`."""
    if stage not in _PERCENT:
        return 0.0
    names = list(_PERCENT)
    before = sum(_PERCENT[name] for name in names[: names.index(stage)])
    return (before + _PERCENT[stage] * of_stage) / sum(_PERCENT.values())
