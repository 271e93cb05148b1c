"""Stopping a diagnosis before its end: at a time limit, or because somebody asks for it.

A signal is seen by this process and by every process that is made after it: what was asked for is in
shared memory, and `time.monotonic()` is one clock for a whole machine. What runs looks at the signal
between its steps and raises `StoppedEarly`; what has come to a result keeps it.
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
    """A computation ended before it came to a result."""


class StopReason(IntEnum):
    """Who asked for an end."""

    NOBODY = 0
    INTERRUPTED = 1
    TERMINATED = 2


@dataclass(frozen=True, kw_only=True)
class EarlyStop:
    """What a diagnosis that was stopped says of it.

    Attributes:
      why: "limit of 30 s", "interrupted" or "terminated".
      stage: that was cut short, in words.
      left_out: parts of the work that were not done, or not to their end.
      search: whether the search itself was cut short, so that rivals may not have been tried.
    """

    why: str
    stage: str
    left_out: tuple[str, ...]
    search: bool

    @property
    def warning(self) -> str:
        """What was not done, and what that means."""
        meant = "; what was not tried may explain the log as well, or better" if self.search else ""
        left_out = ", ".join(self.left_out)
        return f"stopped early ({self.why}); not done, or not to the end: {left_out}{meant}"


class StopSignal:
    """When a diagnosis has to come to its end.

    Attributes:
      limit_s: for the whole, from `began_s`; None: without a limit.
      left_out: parts of the work that were not done, or not to their end, in their order.
    """

    def __init__(
        self, limit_s: float | None = None, *, began_s: float | None = None, reserve_s: float = 0.0
    ) -> None:
        """A signal that nobody has given yet.

        Args:
          began_s: `time.monotonic()` from which the limit counts; None: now.
          reserve_s: of the limit, kept for what comes after the diagnosis.

        Raises:
          InvalidValue: the limit is no positive time.
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
        """Ask for an end; safe in a handler of signals."""
        self._asked.value = reason

    def reserve(self, seconds_s: float) -> None:
        """Keep more of the limit for the end: before processes that listen are made."""
        self._reserve_s += seconds_s

    @property
    def requested(self) -> StopReason:
        """Who asked for an end."""
        return StopReason(self._asked.value)

    @property
    def left_s(self) -> float:
        """Time for the search and all that is told beside it."""
        return self._ends_s - self._reserve_s - time.monotonic()

    @property
    def due(self) -> bool:
        """Whether to stop."""
        return bool(self.requested) or self.left_s <= 0

    @property
    def over(self) -> bool:
        """Whether the limit is past, or an end was asked for: too late for any result."""
        return bool(self.requested) or self.left_s + self._reserve_s <= 0

    @property
    def why(self) -> str:
        """In words."""
        return self.requested.name.lower() if self.requested else f"limit of {self.limit_s or 0:g} s"

    def leave_out(self, part: str) -> None:
        """Note a part of the work that was not done, or not to its end."""
        if part not in self.left_out:
            self.left_out.append(part)

    def unless_due(self, part: str, make: Callable[[], T]) -> T | None:
        """What is made, or None where there was no time for all of it."""
        made = None if self.due else make()
        if not self.due:
            return made
        self.leave_out(part)
        return None


NEVER = StopSignal()
_HEARD: ContextVar[StopSignal] = ContextVar("heard", default=NEVER)


def stopping() -> bool:
    """Whether what runs in this context has to end."""
    return _HEARD.get().due


def listen(stop: StopSignal) -> None:
    """From now on, what runs in this context ends when the signal is given."""
    _HEARD.set(stop)


@contextmanager
def listening(stop: StopSignal) -> Iterator[None]:
    """What runs inside ends when the signal is given."""
    before = _HEARD.set(stop)
    try:
        yield
    finally:
        _HEARD.reset(before)


def raise_if_stopped() -> None:
    """Called between the steps of what takes long.

    Raises:
      StoppedEarly: the signal has been given.
    """
    stop = _HEARD.get()
    if stop.due:
        raise StoppedEarly(f"stopped early ({stop.why})")
