"""Tasks on an existing cluster of `dask.distributed`.

Workers have this product installed. If a worker is lost, the scheduler gives its task to another. If
the scheduler is lost, this process waits until it is back, and submits the missing tasks again.
"""

import time
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import CancelledError
from typing import Any

from diagnosis.engines.engine import Engine, EngineFailed, Job, Task, refuse_more_losses
from models.errors import InvalidValue

PATIENCE_S = 600.0  # for a scheduler that restarts
_TRY_FOR_S = 5.0  # to connect, before the next try
_LOOK_S = 2.0  # between two looks at the connection


Tell = Callable[[str], None]


def _unheard(news: str) -> None:
    """Ignore news of the connection."""


def on_cluster(address: str, *, patience_s: float = PATIENCE_S, tell: Tell = _unheard) -> Engine:
    """An engine of the workers of a scheduler.

    Args:
      address: address of the scheduler, for example `tcp://host:8786`.
      patience_s: how long to wait for the scheduler, at first and whenever it is lost, s.
      tell: called with news of the connection.

    Raises:
      InvalidValue: dask.distributed is not installed here.
    """
    try:
        import distributed  # noqa: F401, PLC0415 - an optional extra
    except ImportError as error:
        fix = "pip install 'needle-torsion[cluster]', here and on the workers"
        raise InvalidValue("scheduler", address, "dask.distributed to be installed", fix) from error

    def compute(job: Job, tasks: Sequence[Task]) -> Iterator[tuple[Task, Any]]:
        missing, losses = list(tasks), 0
        while missing:
            client = _connected(address, patience_s)
            try:
                for task, result in _until_lost(client, job, missing, tell):
                    missing.remove(task)
                    losses = 0
                    yield task, result
            finally:
                client.close(timeout=_TRY_FOR_S)
            if missing:
                losses += 1
                refuse_more_losses(job, losses, missing)
                tell(f"lost the scheduler {address}; waiting up to {patience_s:g} s for it")

    return compute


def _connected(address: str, patience_s: float) -> Any:
    """A client of the scheduler, as soon as it answers.

    Raises:
      EngineFailed: it does not answer in time.
    """
    from distributed import Client  # noqa: PLC0415 - an optional extra

    deadline = time.monotonic() + patience_s
    while True:
        try:
            return Client(address, timeout=min(_TRY_FOR_S, patience_s), set_as_default=False)
        except OSError as error:
            if time.monotonic() > deadline:
                raise EngineFailed(
                    f"expected a scheduler at {address}, found none for {patience_s:g} s; completed "
                    "work is kept: start the scheduler and its workers, then run the command again "
                    "(a campaign with --resume)"
                ) from error
            time.sleep(min(1.0, patience_s))


def _until_lost(client: Any, job: Job, tasks: Sequence[Task], tell: Tell) -> Iterator[tuple[Task, Any]]:
    """Results as they come; ends early if the connection is lost."""
    calls = {client.submit(job, task, pure=False): task for task in tasks}
    deserted = False
    while calls:
        ended = _ended(client, list(calls))
        if ended is None:
            return
        if not ended and not deserted and _has_no_workers(client):
            deserted = True
            tell(f"the scheduler {client.scheduler.address} has no workers; waiting for them")
        deserted = deserted and not ended
        for call in ended:
            task = calls.pop(call)
            try:
                yield task, _result(call, job, task)
            except CancelledError:
                return


def _ended(client: Any, calls: Sequence[Any]) -> list[Any] | None:
    """Calls that have ended; empty if none has for a while; None: the connection is lost.

    If the scheduler is lost, calls are cancelled; when it is back, it does not know them.
    """
    from distributed import wait  # noqa: PLC0415 - an optional extra

    try:
        with client.as_current():
            return list(wait(calls, timeout=_LOOK_S, return_when="FIRST_COMPLETED").done)
    except TimeoutError:
        return [] if client.status == "running" else None
    except CancelledError:
        return None


def _has_no_workers(client: Any) -> bool:
    """Whether a scheduler without workers answers; False if it does not: then the connection is lost."""
    try:
        return not client.scheduler_info(n_workers=1)["workers"]
    except OSError:
        return False


def _result(call: Any, job: Job, task: Task) -> Any:
    from distributed import KilledWorker  # noqa: PLC0415 - an optional extra

    try:
        return call.result()
    except KilledWorker as killed:
        raise EngineFailed(
            f"several workers died while computing {job.about(task)}: check whether they ran out of "
            "memory, or use smaller pieces (cases_per_piece of a campaign); completed work is kept: run "
            "the command again (a campaign with --resume)"
        ) from killed
