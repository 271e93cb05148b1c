"""A run claims the folder for its results before it has any, so that no other run chooses the same.

While it runs it holds a lock on a file beside the folder, `.needle-claim-NAME`, and removes the file
at the end. A file that is left by a killed run is not locked and claims nothing. On a file system
without locks, every run proceeds as if it were alone.
"""

import os
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from sim.files.failures import failures_of
from sim.files.locks import taken

PREFIX = ".needle-claim-"


@contextmanager
def claiming(place: Path) -> Iterator[bool]:
    """Claim a path while the block lasts; False: another run has claimed it.

    Raises:
      UnwritableOutput: nothing can be written beside it.
    """
    claim = place.with_name(PREFIX + place.name)
    missing = [folder for folder in place.parents if not folder.exists()]
    with failures_of(place.parent):
        place.parent.mkdir(parents=True, exist_ok=True)
        handle = os.open(claim, os.O_RDWR | os.O_CREAT | os.O_NOFOLLOW, 0o666)
    ours = taken(handle) is not False and _is_still_there(claim, handle)
    try:
        yield ours
    finally:
        if ours:
            claim.unlink(missing_ok=True)
        os.close(handle)
        for folder in missing:
            with suppress(OSError):  # somebody has put something there
                folder.rmdir()


def _is_still_there(claim: Path, handle: int) -> bool:
    """Whether the file still exists: its former owner may have removed it before we took the lock."""
    with suppress(FileNotFoundError):
        return os.path.samestat(claim.stat(), os.fstat(handle))
    return False
