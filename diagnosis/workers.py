"""Runs one function on many arguments, in several processes if there are several.

Each call returns, in order, its value, or a `Failure` if it could not be simulated or was stopped.
Other errors are raised, from workers too. Worker processes end with this one, however it ends.

Cores that no other process computes on are used by threads within calls (diagnosis.cores). Libraries of
linear algebra get one thread per process, this one included: with one per core in each, they would wait
for each other.
Results do not depend on any of this.
"""

import os
import signal
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Executor, Future, ProcessPoolExecutor, wait
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from functools import partial
from multiprocessing import active_children, parent_process
from threading import Thread
from typing import Any, TypeVar

from threadpoolctl import threadpool_limits

from diagnosis.cores import Cores, computing, share, sharing
from diagnosis.stopping import NEVER, StoppedEarly, StopSignal, listen
from sim.needles.run import SimulationFailed

Heard = Callable[[str, int, int], None]
"""Is told the stage, its tasks that are done, and all of them."""
T = TypeVar("T")

_LOOK_S = 0.1  # between two looks at the signal to stop


def unheard(stage: str, done: int, tasks: int) -> None:
    """Ignore progress."""


@dataclass(frozen=True, kw_only=True)
class Failure:
    """A computation that failed.

    Attributes:
      effects: effects that it was about.
      reason: message of the error.
      stopped: whether it was stopped early.
    """

    effects: tuple[str, ...]
    reason: str
    stopped: bool = False


@dataclass(frozen=True, kw_only=True)
class Task:
    """A call to make: the effects that it is about, and the arguments."""

    effects: tuple[str, ...]
    arguments: tuple[Any, ...]


@dataclass(frozen=True, kw_only=True)
class Workers:
    """Worker processes, with a watcher of their progress and a signal to stop.

    Attributes:
      pool: None: compute in this process.
      count: number of processes.
    """

    pool: Executor | None = None
    count: int = 1
    progress: Heard = unheard
    stop: StopSignal = NEVER

    def each(self, stage: str, function: Callable[..., T], tasks: Sequence[Task]) -> list[T | Failure]:
        """Values or failures, in the order of the tasks.

        After a stop, waiting tasks are not begun, and running ones are not awaited.

        Raises:
          Exception: any error of a call except SimulationFailed.
        """
        found = (
            self._over_processes(self.pool, stage, function, tasks)
            if self.pool
            else self._here(stage, function, tasks)
        )
        if any(isinstance(result, Failure) and result.stopped for result in found):
            self.stop.leave_out(stage)
        return found

    def begin(self, function: Callable[..., T], *arguments: Any) -> Callable[[], T]:
        """A call whose value is computed meanwhile; without other processes, once it is asked for.

        Its errors are raised where the value is asked for, whatever they are.
        """
        if self.pool is None:
            return partial(function, *arguments)
        return self.pool.submit(_computed_in_pool, function, *arguments).result

    def _here(self, stage: str, function: Callable[..., T], tasks: Sequence[Task]) -> list[T | Failure]:
        found: list[T | Failure] = []
        for task in tasks:
            self.progress(stage, len(found), len(tasks))
            found.append(_undone(task) if self.stop.due else attempt(function, task))
        self.progress(stage, len(found), len(tasks))
        return found

    def _over_processes(
        self, pool: Executor, stage: str, function: Callable[..., T], tasks: Sequence[Task]
    ) -> list[T | Failure]:
        calls = [pool.submit(_attempt_in_pool, function, task) for task in tasks]
        running: set[Future[T | Failure]] = set(calls)
        while running and not self.stop.due:
            self.progress(stage, len(calls) - len(running), len(calls))
            running = wait(running, timeout=_LOOK_S, return_when=FIRST_COMPLETED).not_done
        for call in running:
            call.cancel()
        self.progress(stage, len(calls) - len(running), len(calls))
        each = zip(calls, tasks, strict=True)
        return [_undone(task) if call in running else call.result() for call, task in each]


def attempt(function: Callable[..., T], task: Task) -> T | Failure:
    """The value of a call, or a failure if it could not be simulated, or was stopped."""
    try:
        return function(*task.arguments)
    except SimulationFailed as failed:
        return Failure(effects=task.effects, reason=str(failed))
    except StoppedEarly as stopped:
        return Failure(effects=task.effects, reason=str(stopped), stopped=True)


def _undone(task: Task) -> Failure:
    return Failure(effects=task.effects, reason="stopped early: not tried", stopped=True)


def _attempt_in_pool(function: Callable[..., T], task: Task) -> T | Failure:
    """The same in a process of the pool."""
    return _computed_in_pool(attempt, function, task)


def _computed_in_pool(function: Callable[..., T], *arguments: Any) -> T:
    """A value that a process of the pool computes, which shares its cores with others."""
    with computing():
        return function(*arguments)


@contextmanager
def process_pool(
    count: int,
    progress: Heard = unheard,
    stop: StopSignal = NEVER,
    *,
    meanwhile: Callable[[], object] | None = None,
) -> Iterator[Workers]:
    """Forked processes, which end with the block; with a count of 1, this process computes.

    Args:
      meanwhile: called in a thread of this process, which has less to do than the others; they do not
        see what it changes. Its errors are ignored.
    """
    if count <= 1:
        yield Workers(progress=progress, stop=stop)
        return
    others, cores = active_children(), Cores(count=count)
    pool = _Pool(count, initializer=_begin, initargs=(stop, cores))
    if meanwhile is not None:
        pool.beside = Thread(target=_ignoring_errors, args=(meanwhile,), daemon=True)
    try:
        with sharing(cores), threadpool_limits(1):
            yield Workers(pool=pool, count=count, progress=progress, stop=stop)
    finally:
        pool.shutdown(wait=False, cancel_futures=True)
        ours = [process for process in active_children() if process not in others]
        for process in ours:
            process.kill()
        for process in ours:
            process.join()
        pool.wait_for_the_thread()  # last: who interrupts this waits for no process that is left


class _Pool(ProcessPoolExecutor):
    """A pool that starts a thread of this process with the first call.

    The processes are forked by then: they would share the locks of the thread.
    """

    beside: Thread | None = None

    def submit(self, fn: Callable[..., T], /, *args: Any, **kwargs: Any) -> Future[T]:
        """As that of every executor."""
        call = super().submit(fn, *args, **kwargs)
        if self.beside is not None and self.beside.ident is None:
            self.beside.start()
        return call

    def wait_for_the_thread(self) -> None:
        """Before this process forks again."""
        if self.beside is not None and self.beside.ident is not None:
            self.beside.join()


def _ignoring_errors(call: Callable[[], object]) -> None:
    with suppress(Exception):
        call()


def _begin(stop: StopSignal, cores: Cores) -> None:
    """Initialise a process of the pool.

    Signals reach the whole process group; only the parent reacts to them.
    """
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.signal(signal.SIGTERM, signal.SIG_IGN)
    threadpool_limits(1)
    share(cores)
    listen(stop)
    Thread(target=_end_with_the_parent, daemon=True).start()


def _end_with_the_parent() -> None:
    """End this process with its parent, even if that is killed."""
    parent = parent_process()
    if parent is not None:
        parent.join()
    os._exit(1)
