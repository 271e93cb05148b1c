"""Running one function on many arguments, over processes where there are several."""

import signal
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Executor, ProcessPoolExecutor
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from typing import Any, TypeVar

from models.errors import NeedleError
from sim.simulation import prepare_processes

Progress = Callable[[str, float], None]
T = TypeVar("T")


def silent(what: str, share: float) -> None:
    """Progress that nobody watches."""


@dataclass(frozen=True, kw_only=True)
class Team:
    """Workers, and who is told how far they are.

    Attributes:
      pool: None works in this process.
    """

    pool: Executor | None = None
    progress: Progress = silent

    def each(self, what: str, function: Callable[..., T], calls: Sequence[tuple[Any, ...]]) -> list[T]:
        """Results in order; what cannot be simulated is left out."""
        tasks = [self.pool.submit(function, *call) for call in calls] if self.pool else None
        found = []
        for i, call in enumerate(calls):
            with suppress(NeedleError):  # what cannot be simulated explains nothing
                found.append(tasks[i].result() if tasks else function(*call))
            self.progress(what, (i + 1) / len(calls))
        return found


@contextmanager
def team(workers: int, progress: Progress = silent) -> Iterator[Team]:
    """A team of processes, which inherit the compiled callback; 1 works in this one."""
    prepare_processes()
    if workers <= 1:
        yield Team(progress=progress)
        return
    with ProcessPoolExecutor(workers, initializer=_leave_interrupts_to_the_parent) as pool:
        try:
            yield Team(pool=pool, progress=progress)
        except BaseException:
            pool.shutdown(cancel_futures=True)  # after what runs, some seconds at the most
            raise


def _leave_interrupts_to_the_parent() -> None:
    signal.signal(signal.SIGINT, signal.SIG_IGN)
