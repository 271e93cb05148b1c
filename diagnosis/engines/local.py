"""Tasks on processes of this machine, which end with this one, however it ends."""

from collections.abc import Iterator, Sequence
from concurrent.futures import as_completed
from concurrent.futures.process import BrokenProcessPool
from typing import Any

from diagnosis.engines.engine import Engine, Job, Task, refuse_more_losses
from diagnosis.workers import process_pool
from sim.simulation import prepare_processes


def on_this_machine(workers: int) -> Engine:
    """An engine of so many processes; with 1, this process computes.

    If a process dies, all are ended, and new ones compute the missing tasks.
    """

    def compute(job: Job, tasks: Sequence[Task]) -> Iterator[tuple[Task, Any]]:
        prepare_processes()
        missing, losses = list(tasks), 0
        while missing:
            try:
                for task, result in _until_one_dies(job, missing, workers):
                    missing.remove(task)
                    losses = 0
                    yield task, result
            except BrokenProcessPool:
                losses += 1
                refuse_more_losses(job, losses, missing)

    return compute


def _until_one_dies(job: Job, tasks: Sequence[Task], workers: int) -> Iterator[tuple[Task, Any]]:
    with process_pool(min(workers, len(tasks))) as crew:
        if crew.pool is None:
            yield from ((task, job(task)) for task in list(tasks))
            return
        calls = {crew.pool.submit(job, task): task for task in tasks}
        for call in as_completed(calls):
            yield calls.pop(call), call.result()
