"""Ctrl-C and SIGTERM: the first asks a diagnosis for its best result so far, the second ends it."""

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
    """The first signal to this process requests a stop; further ones are handled by Python as usual.

    A signal to the whole process group also reaches child processes that still have these handlers:
    they ignore it.
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
