"""Ctrl-C and SIGTERM: once asks a diagnosis for the best so far, twice ends it at once."""

import os
import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType

from diagnosis.stopping import StopReason, StopSignal
from scripts.exit_codes import ExitCode

_REASONS = {signal.SIGINT: StopReason.INTERRUPTED, signal.SIGTERM: StopReason.TERMINATED}
EXIT_CODES = {
    StopReason.NOBODY: ExitCode.DONE,
    StopReason.INTERRUPTED: ExitCode.INTERRUPTED,
    StopReason.TERMINATED: ExitCode.TERMINATED,
}


@contextmanager
def stops_on_signals(stop: StopSignal) -> Iterator[None]:
    """Signals to this process ask for an end; signals that come then are those of Python.

    A signal to the whole group also reaches processes that this one has just made, which still have
    its handlers: they leave it to this one.
    """
    if threading.current_thread() is not threading.main_thread():
        yield  # only the main thread hears of signals
        return

    this_process = os.getpid()

    def ask(number: int, _: FrameType | None) -> None:
        if os.getpid() != this_process:
            return
        if stop.requested:
            raise KeyboardInterrupt if number == signal.SIGINT else SystemExit(128 + number)
        stop.request(_REASONS[signal.Signals(number)])

    before = {number: signal.signal(number, ask) for number in _REASONS}
    try:
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
