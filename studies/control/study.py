"""Every stage of `needle control`, its independent parts spread over processes."""

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


def stage_parts() -> dict[str, list[Part]]:
    """The parts of every stage, in order; none needs what another made."""
    rigs = (*plants(), *misjudged_delays())
    return {
        "Tables IV and V": [tables_iv_v],
        "robustness": [partial(robustness, rigs=(rig,)) for rig in rigs],
        **steering_parts(),
    }


def run_study(progress: Callable[[str], None] = lambda stage: None, *, workers: int = 2) -> ControlStudy:
    """Run everything; about two minutes on two cores.

    Args:
      progress: called with the name of each stage as its results are collected.
      workers: processes.
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
    stages: dict[str, list[Part]], pool: Executor | None, progress: Callable[[str], None]
) -> dict[str, list[Any]]:
    """What every part of every stage returns, in order."""
    waiting = {
        stage: [pool.submit(part).result if pool else part for part in parts]
        for stage, parts in stages.items()
    }
    made = {}
    for stage, results in waiting.items():
        progress(stage)
        made[stage] = [result() for result in results]
    return made
