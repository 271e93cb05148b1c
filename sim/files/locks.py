"""Locks on folders, by the operating system: they end with the process that holds them.

On a file system without locks, a run proceeds as if it were alone, and removes nothing of others.
"""

import fcntl
import os
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from models.errors import UnwritableOutput

_MOST_S = 60.0  # longest wait for another run that holds a folder: it only moves a few files
_LOOK_S = 0.02


@contextmanager
def holding(folder: Path) -> Iterator[None]:
    """Hold the lock of a folder while the block lasts; wait up to a minute for other runs.

    Raises:
      UnwritableOutput: another run has held it for a minute.
      OSError: there is no such folder.
    """
    handle = os.open(folder, os.O_RDONLY)
    try:
        ends_s = time.monotonic() + _MOST_S
        while taken(handle) is False:
            if time.monotonic() > ends_s:
                raise UnwritableOutput(
                    f"{folder}: another run has written here for {_MOST_S:g} s; wait for it, or stop it"
                )
            time.sleep(_LOOK_S)
        yield
    finally:
        os.close(handle)


@contextmanager
def left_alone(folder: Path) -> Iterator[bool]:
    """Whether no other run holds a folder; if so, this one holds it while the block lasts."""
    handle = os.open(folder, os.O_RDONLY)
    try:
        yield taken(handle) is True
    finally:
        os.close(handle)


def taken(handle: int) -> bool | None:
    """Try to lock an open file; returns whether that worked, None where there are no locks."""
    try:
        fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        return False
    except OSError:
        return None
    return True
