"""Writing results: complete or not at all, and replacing existing files only if asked to."""

import os
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from models.errors import OutputExists


def refuse_existing(paths: list[Path], *, force: bool) -> None:
    """Raise before any work is done if a result would overwrite something.

    Raises:
      OutputExists: names the first path, and how to choose another or replace it.
    """
    for path in paths:
        if path.exists() and not force:
            raise OutputExists(f"{path} exists; give another path, or --force to replace it")


@contextmanager
def writing(path: Path, *, force: bool = False) -> Iterator[Path]:
    """A temporary path beside `path` that replaces it when the block ends well.

    Raises:
      OutputExists: `path` exists and `force` is not given.
    """
    refuse_existing([path], force=force)
    path.parent.mkdir(parents=True, exist_ok=True)
    handle, name = tempfile.mkstemp(prefix=f".{path.stem}-", suffix=path.suffix, dir=path.parent)
    os.close(handle)
    part = Path(name)
    try:
        yield part
        part.chmod(0o644)
        os.replace(part, path)
    finally:
        part.unlink(missing_ok=True)


def write_text(path: Path, text: str, *, force: bool = False) -> None:
    """Write a text file whole."""
    with writing(path, force=force) as part:
        part.write_text(text, encoding="utf-8")
