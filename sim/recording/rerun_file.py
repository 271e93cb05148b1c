"""A rerun recording as a file that is whole.

Output only: nothing that computes imports this module. The library writes files in a thread of its own,
which logs that a disk is full and goes on, or waits for ever. So it records into memory, and the bytes
are written here: 4 MB for a gap report, 1 MB for an insertion.
"""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import rerun as rr
from rerun.chunk import RrdReader

from models.errors import UnwritableOutput
from sim.files import writing


@contextmanager
def recorded(
    application: str, layout: Any, path: Path, *, force: bool = False
) -> Iterator[rr.RecordingStream]:
    """A stream whose content is that of `path` when the block ends well.

    Args:
      layout: a blueprint that the viewer starts with.

    Raises:
      OutputExists: the path exists and `force` is not given.
      UnwritableOutput: the file cannot be written, or is not whole when read back.
    """
    rr.set_strict_mode(True)
    with writing(path, force=force) as part:
        stream = rr.RecordingStream(application)
        memory = stream.memory_recording()
        stream.send_blueprint(layout, make_active=False, make_default=True)
        yield stream
        part.write_bytes(memory.drain_as_bytes())
        stream.disconnect()
        _refuse_incomplete(part, path)


def _refuse_incomplete(part: Path, path: Path) -> None:
    """The list of its content is the last that a recording holds, and says how long it has to be."""
    try:
        RrdReader(str(part)).store()
    except Exception as error:  # rerun documents no type
        raise UnwritableOutput(f"{path}: incomplete when read back ({error}); try once more") from error
