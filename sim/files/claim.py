"""A place that a run has chosen for its results before it has any, so that no other run chooses it too.

While a run lasts it holds the lock of a file beside the place, `.needle-claim-NAME`, which it removes in
the end. What a run that was killed leaves of it is nobody's. Where a file system knows no locks, every
run goes on as if it were alone.
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
    """Whether a place is this run's while the block lasts; False: another one has it.

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
    """Whether the file was not removed by its former owner before its lock was taken here."""
    with suppress(FileNotFoundError):
        return os.path.samestat(claim.stat(), os.fstat(handle))
    return False
