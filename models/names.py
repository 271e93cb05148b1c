"""Names that become file names (protocols, trials): impossible ones are refused when they are read."""

from pathlib import Path

from models.errors import InvalidValue
from models.user_text import unprintable

MOST_BYTES = 200
"""Physical: file systems take names of 255 bytes; a temporary name and an ending come on top."""


def refuse_no_file_name(field: str, name: str) -> None:
    """Check that a name is a plain file name, without a path to another folder.

    Raises:
      InvalidValue: names the field, what was found and how to fix it.
    """
    expected = "a valid file name"
    if not name.strip() or name in (".", ".."):
        raise InvalidValue(field, name, expected, "give it a name of letters and digits")
    if "/" in name or "\\" in name:
        raise InvalidValue(field, name, expected, "remove the slashes: this is a name, not a path")
    if unprintable(name) or "\n" in name or "\t" in name:
        raise InvalidValue(field, name, expected, "remove the control characters")
    size = len(name.encode("utf-8"))
    if size > MOST_BYTES:
        raise InvalidValue(
            field, name, f"{expected}, of at most {MOST_BYTES} bytes, not {size}", "shorten it"
        )


def is_file(path: Path) -> bool:
    """Whether the file exists; False, too, for a path that no file system allows."""
    try:
        return path.is_file()
    except (OSError, ValueError):
        return False


def is_folder(path: Path) -> bool:
    """Whether the folder exists; False, too, for a path that no file system allows."""
    try:
        return path.is_dir()
    except (OSError, ValueError):
        return False
