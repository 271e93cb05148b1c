"""Stops a diagnosis early: at a time limit, or on request.

A signal is visible in this process and in every process that is made after it: the request is in
shared memory, and `time.monotonic()` is one clock for the whole machine. Computations check the signal
between their steps and raise `StoppedEarly`; results that exist are kept.
"""

import math
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass
from enum import IntEnum
from multiprocessing.sharedctypes import RawValue
from typing import TypeVar

from models.errors import InvalidValue, NeedleError

T = TypeVar("T")


class StoppedEarly(NeedleError):
    """A computation was stopped before it had a result."""


class StopReason(IntEnum):
    """The reason of a stop."""

    NOBODY = 0
    INTERRUPTED = 1
    TERMINATED = 2


@dataclass(frozen=True, kw_only=True)
class EarlyStop:
    """What a stopped diagnosis reports about the stop.

    Attributes:
      why: "limit of 30 s", "interrupted" or "terminated".
      stage: stage that was stopped, in words.
      left_out: parts of the work that were not done, or not completed.
      search: whether the search itself was stopped, so that some explanations may not have been tried.
    """

    why: str
    stage: str
    left_out: tuple[str, ...]
    search: bool

    @property
    def warning(self) -> str:
        """A warning: what was not done, and what this means."""
        meant = "; what was not tried may explain the log as well, or better" if self.search else ""
        left_out = ", ".join(self.left_out)
        return f"stopped early ({self.why}); not done, or not to the end: {left_out}{meant}"


class StopSignal:
    """Tells when a diagnosis has to stop.

    Attributes:
      limit_s: time limit from `began_s`, s; None: no limit.
      left_out: parts of the work that were not done, or not completed, in order.
    """

    def __init__(
        self, limit_s: float | None = None, *, began_s: float | None = None, reserve_s: float = 0.0
    ) -> None:
        """A new signal, which has not been given yet.

        Args:
          began_s: `time.monotonic()` from which the limit counts; None: now.
          reserve_s: part of the limit that is kept for the time after the diagnosis.

        Raises:
          InvalidValue: the limit is not a positive time.
        """
        if limit_s is not None and not 0 < limit_s < math.inf:
            raise InvalidValue("limit", limit_s, "seconds above 0", "leave it out for no limit")
        self.limit_s = limit_s
        self.left_out: list[str] = []
        began_s = time.monotonic() if began_s is None else began_s
        self._ends_s = math.inf if limit_s is None else began_s + limit_s
        self._reserve_s = reserve_s
        self._asked = RawValue("b", StopReason.NOBODY)

    def request(self, reason: StopReason) -> None:
        """Request a stop; safe in a signal handler."""
        self._asked.value = reason

    def reserve(self, seconds_s: float) -> None:
        """Reserve more of the limit for the end; call it before worker processes are made."""
        self._reserve_s += seconds_s

    @property
    def requested(self) -> StopReason:
        """The reason of the request, if there is one."""
        return StopReason(self._asked.value)

    @property
    def left_s(self) -> float:
        """Remaining time for search and assessment, s."""
        return self._ends_s - self._reserve_s - time.monotonic()

    @property
    def due(self) -> bool:
        """Whether to stop."""
        return bool(self.requested) or self.left_s <= 0

    @property
    def over(self) -> bool:
        """Whether the whole limit has passed, or a stop was requested: too late for any result."""
        return bool(self.requested) or self.left_s + self._reserve_s <= 0

    @property
    def why(self) -> str:
        """The reason of the stop in words."""
        return self.requested.name.lower() if self.requested else f"limit of {self.limit_s or 0:g} s"

    def leave_out(self, part: str) -> None:
        """Note a part of the work that was not done, or not completed."""
        if part not in self.left_out:
            self.left_out.append(part)

    def unless_due(self, part: str, make: Callable[[], T]) -> T | None:
        """The result of `make`, or None if there was not enough time."""
        made = None if self.due else make()
        if not self.due:
            return made
        self.leave_out(part)
        return None


NEVER = StopSignal()
_HEARD: ContextVar[StopSignal] = ContextVar("heard", default=NEVER)


def stopping() -> bool:
    """Whether computations in this context have to stop."""
    return _HEARD.get().due


def listen(stop: StopSignal) -> None:
    """From now on, computations in this context stop when the signal is given."""
    _HEARD.set(stop)


@contextmanager
def listening(stop: StopSignal) -> Iterator[None]:
    """Computations inside the block stop when the signal is given."""
    before = _HEARD.set(stop)
    try:
        yield
    finally:
        _HEARD.reset(before)


def raise_if_stopped() -> None:
    """To be called between the steps of long computations.

    Raises:
      StoppedEarly: the signal has been given.
    """
    stop = _HEARD.get()
    if stop.due:
        raise StoppedEarly(f"stopped early ({stop.why})")
