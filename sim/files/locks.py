"""Who is at work in a folder: locks of the system, which end with the process that holds them.

Some file systems know no locks. There a run goes on as if it were alone, and clears nothing away.
"""

import fcntl
import os
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from models.errors import UnwritableOutput

_MOST_S = 60.0  # for which another run may hold a folder: it moves a few files meanwhile
_LOOK_S = 0.02


@contextmanager
def holding(folder: Path) -> Iterator[None]:
    """Alone in a folder among all runs, once the others that hold it are done.

    Raises:
      UnwritableOutput: another run holds it for a minute.
      OSError: there is no such folder.
    """
    handle = os.open(folder, os.O_RDONLY)
    try:
        ends_s = time.monotonic() + _MOST_S
        while taken(handle) is False:
            if time.monotonic() > ends_s:
                raise UnwritableOutput(f"{folder}: another run writes here and does not end; stop it")
            time.sleep(_LOOK_S)
        yield
    finally:
        os.close(handle)


@contextmanager
def left_alone(folder: Path) -> Iterator[bool]:
    """Whether nobody holds a folder any more, which is then held by this process."""
    handle = os.open(folder, os.O_RDONLY)
    try:
        yield taken(handle) is True
    finally:
        os.close(handle)


def taken(handle: int) -> bool | None:
    """Whether the lock of an open file is ours now; None where there are no locks."""
    try:
        fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        return False
    except OSError:
        return None
    return True
