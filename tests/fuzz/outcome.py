"""Outcome of one input, within bounds of time and memory."""

import resource
import signal
import time
import traceback
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from enum import StrEnum

from models.errors import NeedleError

MOST_CPU_S = 20.0
MOST_BYTES = 3_000_000_000
"""Of one input. A good one takes a fraction of a second and some megabytes."""


_TELLING = ("expected", "is missing; ", "appears twice; ")
"""An error says what was expected, or what is missing or too much, and how to fix it."""


class Kind(StrEnum):
    """How an input ended; all but a fault are as they should be."""

    ERROR = "errors"
    WARNING = "warnings"
    RIGHT = "right answers"
    FAULT = "faults"


class TooLong(BaseException):
    """An input took more time than its bound."""


@dataclass(frozen=True)
class Outcome:
    """How an input ended, what was said, and the time that it took."""

    kind: Kind
    said: str
    cpu_s: float


def outcome(
    action: Callable[[], Sequence[str]],
    *,
    names: Sequence[str],
    same: bool,
    expected: Sequence[str] = (),
) -> Outcome:
    """Run an action on an input.

    Args:
      action: returns the warnings that were told.
      names: of files, one of which an error has to name; empty: the command says it otherwise.
      same: the input means what the good one means: it has to be read without an error, and with the
        warnings of the good one, `expected`.
    """
    start = time.process_time()
    try:
        with _bounded():
            warnings = list(action())
        if same and warnings != list(expected):
            kind, said = Kind.FAULT, f"other warnings: {warnings}"
        else:
            kind, said = Kind.WARNING if warnings else Kind.RIGHT, "; ".join(warnings)
    except NeedleError as error:
        kind, said = Kind.ERROR, str(error)
        if same:
            kind, said = Kind.FAULT, f"refused, though nothing has changed: {said}"
        elif names and not any(name in said for name in names):
            kind, said = Kind.FAULT, f"names no file: {said}"
        elif not any(word in said for word in _TELLING):
            kind, said = Kind.FAULT, f"says nothing of what was expected: {said}"
    except (Exception, TooLong):
        kind, said = Kind.FAULT, traceback.format_exc()
    return Outcome(kind, said, time.process_time() - start)


@contextmanager
def _bounded() -> Iterator[None]:
    """Bounds of processor time and memory; both raise."""
    limits = resource.getrlimit(resource.RLIMIT_AS)
    with open("/proc/self/statm") as file:
        used = int(file.read().split()[0]) * resource.getpagesize()
    before = signal.signal(signal.SIGPROF, _too_long)
    resource.setrlimit(resource.RLIMIT_AS, (used + MOST_BYTES, limits[1]))
    signal.setitimer(signal.ITIMER_PROF, MOST_CPU_S)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
        signal.signal(signal.SIGPROF, before)
        resource.setrlimit(resource.RLIMIT_AS, limits)


def _too_long(*_: object) -> None:
    raise TooLong(f"more than {MOST_CPU_S} s of processor time")
