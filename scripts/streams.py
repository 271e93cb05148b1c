"""Standard output and standard error: each may be full, closed, or unable to show some characters."""

import os
import sys
from contextlib import suppress
from io import TextIOWrapper

from rich.text import Text

from scripts.terminal import terminal


def show_what_can_be_shown() -> None:
    """Replace characters that a terminal cannot show by question marks, instead of failing."""
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, TextIOWrapper):
            stream.reconfigure(errors="replace")


def flush_output() -> None:
    """Flush standard output now, while an error can still be reported.

    Raises:
      OSError: standard output is full or closed.
    """
    if sys.stdout:
        sys.stdout.flush()


def give_up_output() -> None:
    """Discard output that cannot be written, so that Python reports no error at exit."""
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
