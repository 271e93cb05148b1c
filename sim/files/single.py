"""One file, written completely or not at all."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from sim.files.destination import Destination
from sim.files.journal import is_of_a_run
from sim.files.publish import publishing


@contextmanager
def writing(path: Path, *, force: bool = False) -> Iterator[Path]:
    """A temporary path whose content becomes that of `path` when the block ends without an error.

    Within a set that is being published it is `path` itself, since the set is published as a whole.

    Raises:
      OutputExists, UnsafeOutput, UnwritableOutput: it may not or cannot be written.
    """
    if any(is_of_a_run(name) for name in path.parts):
        path.parent.mkdir(parents=True, exist_ok=True)
        yield path
        return
    with publishing(Destination(folder=path.parent, force=force), [path]) as results:
        yield results.at(path)


def write_text(path: Path, text: str, *, force: bool = False) -> None:
    """Write a text file, completely or not at all."""
    with writing(path, force=force) as part:
        part.write_text(text, encoding="utf-8")
