"""Running one function on many arguments, over processes where there are several.

Every call comes back, in order: as its value, or as a `Failure` that names what could not be
simulated. Misuse is no failure of a simulation: it is raised, from a worker too.

Where there are fewer calls than processes, the cores that are left go to threads within a call
(`side_by_side`): simulations run without Python's lock. Results depend on neither.
"""

import signal
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Executor, ProcessPoolExecutor, ThreadPoolExecutor
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass
from typing import Any, TypeVar

from sim.simulation import SimulationFailed

Progress = Callable[[str, float], None]
T = TypeVar("T")
S = TypeVar("S")

_THREADS: ContextVar[int] = ContextVar("threads", default=1)
"""That a call may use here and now."""


def silent(stage: str, share: float) -> None:
    """Progress that nobody watches."""


@dataclass(frozen=True, kw_only=True)
class Failure:
    """A computation that could not be carried out.

    Attributes:
      effects: that it was about.
      reason: why, in the words of what failed.
    """

    effects: tuple[str, ...]
    reason: str


@dataclass(frozen=True, kw_only=True)
class Task:
    """A call to make: the effects that it is about, and the arguments."""

    effects: tuple[str, ...]
    arguments: tuple[Any, ...]


@dataclass(frozen=True, kw_only=True)
class Workers:
    """Processes, and who is told how far they are.

    Attributes:
      pool: None works in this process.
      count: of processes.
    """

    pool: Executor | None = None
    count: int = 1
    progress: Progress = silent

    def each(self, stage: str, function: Callable[..., T], tasks: Sequence[Task]) -> list[T | Failure]:
        """Values or failures, in the order of the tasks.

        Raises:
          Exception: whatever a call raises but SimulationFailed.
        """
        threads = max(1, self.count // max(len(tasks), 1))
        pending = (
            [self.pool.submit(_attempt_on, threads, function, task) for task in tasks]
            if self.pool
            else None
        )
        results: list[T | Failure] = []
        for i, task in enumerate(tasks):
            results.append(pending[i].result() if pending else attempt(function, task))
            self.progress(stage, (i + 1) / len(tasks))
        return results


def attempt(function: Callable[..., T], task: Task) -> T | Failure:
    """The value of a call, or why it could not be simulated."""
    try:
        return function(*task.arguments)
    except SimulationFailed as failed:
        return Failure(effects=task.effects, reason=str(failed))


def _attempt_on(threads: int, function: Callable[..., T], task: Task) -> T | Failure:
    """The same in a process of the pool, which has so many cores to itself."""
    _THREADS.set(threads)
    return attempt(function, task)


def side_by_side(function: Callable[[S], T], items: Sequence[S]) -> list[T]:
    """The function of each item, in order, on the threads that this call may use.

    Raises:
      Exception: what the first item raises that raises anything.
    """
    threads = min(_THREADS.get(), len(items))
    if threads <= 1:
        return [function(item) for item in items]
    with ThreadPoolExecutor(threads) as pool:
        return list(pool.map(function, items))


@contextmanager
def process_pool(count: int, progress: Progress = silent) -> Iterator[Workers]:
    """Processes that share what this one has loaded; 1 works in this one."""
    if count <= 1:
        yield Workers(progress=progress)
        return
    before = _THREADS.set(count)
    with ProcessPoolExecutor(count, initializer=_leave_interrupts_to_the_parent) as pool:
        try:
            yield Workers(pool=pool, count=count, progress=progress)
        except BaseException:
            pool.shutdown(cancel_futures=True)  # after what runs, some seconds at the most
            raise
        finally:
            _THREADS.reset(before)


def _leave_interrupts_to_the_parent() -> None:
    signal.signal(signal.SIGINT, signal.SIG_IGN)
