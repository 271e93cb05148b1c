"""Cores that processes share, and threads on those that no other process computes on.

Simulations release Python's lock, so that several trials may run side by side in one process. Results
do not depend on how many do.
"""

from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass, field, replace
from multiprocessing import Value
from typing import Any, TypeVar

T = TypeVar("T")
S = TypeVar("S")


@dataclass(frozen=True, kw_only=True)
class Cores:
    """Cores that processes share.

    Attributes:
      count: all of them.
      busy: number of processes that compute now, shared memory.
      own: how many of these are this one: 0 or 1.
    """

    count: int = 1
    busy: Any = field(default_factory=lambda: Value("i", 0))
    own: int = 0

    @property
    def free(self) -> int:
        """Cores that no other process computes on: one at least."""
        return max(1, self.count - int(self.busy.value) + self.own)


_ALONE = Cores()
_CORES: ContextVar[Cores] = ContextVar("cores", default=_ALONE)


@contextmanager
def sharing(cores: Cores) -> Iterator[None]:
    """Use these cores."""
    before = _CORES.set(cores)
    try:
        yield
    finally:
        _CORES.reset(before)


def share(cores: Cores) -> None:
    """Use these cores as long as the process lives."""
    _CORES.set(cores)


@contextmanager
def computing() -> Iterator[None]:
    """Let the processes that share the cores know that this one computes."""
    cores = _CORES.get()
    with cores.busy.get_lock():
        cores.busy.value += 1
    try:
        with sharing(replace(cores, own=1)):
            yield
    finally:
        with cores.busy.get_lock():
            cores.busy.value -= 1


def side_by_side(function: Callable[[S], T], items: Sequence[S]) -> list[T]:
    """The function of each item, in order, on the cores that no other process computes on.

    Raises:
      Exception: the error of the first item that fails.
    """
    threads = min(_CORES.get().free, len(items))
    if threads <= 1:
        return [function(item) for item in items]
    with ThreadPoolExecutor(threads) as pool:
        return list(pool.map(function, items))
