"""A rerun recording as a complete file.

Output only: nothing that computes imports this module. rerun writes files in a thread of its own,
which only logs a full disk, or waits for ever. So it records into memory here, and this module
writes the bytes: 4 MB for a gap report, 1 MB for an insertion.
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
    """A stream that is written to `path` when the block ends without an error.

    Args:
      layout: blueprint with which the viewer starts.

    Raises:
      OutputExists: the path exists and `force` is not given.
      UnwritableOutput: the file cannot be written, or is incomplete when read back.
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
    """Check the length of a recording by its footer, which is written last and lists the content."""
    try:
        RrdReader(str(part)).store()
    except Exception as error:  # rerun documents no type
        raise UnwritableOutput(f"{path}: incomplete when read back ({error}); try once more") from error
