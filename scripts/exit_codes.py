"""The exit codes of `needle`, their meaning, and how a process ends with one."""

import atexit
import os
import sys
from contextlib import suppress
from enum import IntEnum
from typing import NoReturn


class ExitCode(IntEnum):
    """A code, and what it means in words."""

    words: str

    def __new__(cls, code: int, words: str) -> "ExitCode":
        """An integer that knows its meaning."""
        member = int.__new__(cls, code)
        member._value_ = code
        member.words = words
        return member

    DONE = 0, "done"
    BOUND_FAILS = 1, "a check of validate or demo failed"
    REFUSED = 2, "wrong arguments or input, or a result exists; or files or output cannot be written"
    WITHOUT_ALL = 3, "done, except for a picture, page or recording that could not be made"
    INTERRUPTED = 130, "stopped by Ctrl-C; diagnose reports the best so far"
    TERMINATED = 143, "stopped by SIGTERM; diagnose reports the best so far"


def in_words() -> str:
    """All codes with their meaning, one line each."""
    return "\n".join(f"  {code.value:>3}  {code.words}" for code in ExitCode)


def let_the_code_stand() -> None:
    """Exit by a code after a Ctrl-C that was handled, also if it came within `exec`.

    CPython takes such a one for unhandled, as in the definition of a data class that is imported: run
    with `-m`, it ends by the signal all the same. It forgets that with the next `exec`.
    """
    exec("")


def end_process(code: int) -> NoReturn:
    """End this process at once with an exit code, after what libraries have registered for its end.

    Python would take apart all modules and objects, which takes longer than to print a help text.
    """
    atexit._run_exitfuncs()
    for stream in filter(None, (sys.stdout, sys.stderr)):
        with suppress(OSError, ValueError):
            stream.flush()
    os._exit(code)
