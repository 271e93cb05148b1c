"""Errors of the system on writing a file, as sentences that name the path and how to fix it."""

import errno
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from models.errors import UnwritableOutput

_ANOTHER = "give another place"
_ADVICE = {
    errno.ENOSPC: "free some space there, or give a place on another disk",
    errno.EDQUOT: "free some space there, or give a place on another disk",
    errno.EFBIG: "give a place where files may be larger",
    errno.EACCES: "give a place that you may write to",
    errno.EPERM: "give a place that you may write to",
    errno.EROFS: "give a place that you may write to",
    errno.ENAMETOOLONG: "give a shorter name",
    errno.ENOTDIR: "give a folder, not a file",
    errno.EISDIR: _ANOTHER,
    errno.ELOOP: "give a place without links that lead in a circle",
    errno.EIO: "check the disk, and give a place on another one",
    errno.ESTALE: "mount the disk again, or give a place on another one",
    errno.EXDEV: "give a folder that is on one disk",
}


def is_of_the_place(error: BaseException) -> bool:
    """Whether the disk or the path is at fault, and not the content."""
    return isinstance(error, OSError) and error.errno in _ADVICE


@contextmanager
def failures_of(folder: Path) -> Iterator[None]:
    """Turn an OSError in the block into an `UnwritableOutput` that names the path, or the folder.

    Raises:
      UnwritableOutput: in place of an OSError.
    """
    try:
        yield
    except OSError as error:
        named = error.filename if isinstance(error.filename, str) else folder
        advice = _ADVICE.get(error.errno or 0, _ANOTHER)
        reason = error.strerror or error
        raise UnwritableOutput(f"{folder}: nothing was written, {named}: {reason}; {advice}") from error
