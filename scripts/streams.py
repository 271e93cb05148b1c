"""Standard output and standard error: either may be full, closed, or unable to show a Greek letter."""

import os
import sys
from contextlib import suppress
from io import TextIOWrapper

from rich.text import Text

from scripts.terminal import terminal


def show_what_can_be_shown() -> None:
    """What a terminal has no sign for is a question mark, and no reason to stop."""
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, TextIOWrapper):
            stream.reconfigure(errors="replace")


def flush_output() -> None:
    """Show all of it now, while an error can still be told.

    Raises:
      OSError: standard output is full or closed.
    """
    if sys.stdout:
        sys.stdout.flush()


def give_up_output() -> None:
    """Let what cannot be shown go, so that Python does not complain when it ends."""
    try:
        flush_output()
    except OSError:
        nowhere = os.open(os.devnull, os.O_WRONLY)
        os.dup2(nowhere, sys.stdout.fileno())
        os.close(nowhere)


def complain(text: str | Text) -> None:
    """Print on standard error, if that can be written to."""
    with suppress(OSError):
        terminal(stderr=True).print(text, highlight=False)
