"""Where results may be written: inside their folder, over earlier results, never over the user's files.

Only this module decides that: every command asks before it computes, and again before files get their
names. `--force` replaces results; it replaces no input of the run, follows no link inside the folder,
and touches nothing outside of it.
"""

import os
import stat
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from models.errors import OutputExists, UnsafeOutput, UnwritableOutput
from sim.files.failures import failures_of


@dataclass(frozen=True, kw_only=True)
class Destination:
    """A folder for results.

    Attributes:
      folder: need not exist; may be a link to a folder, since the user named it.
      inputs: files that the run reads; they are never replaced, whatever their names.
      force: whether existing results are replaced.
    """

    folder: Path
    inputs: tuple[Path, ...] = ()
    force: bool = False

    def check(self, paths: Sequence[Path]) -> None:
        """Refuse results that may not be written; called before any work is done.

        Raises:
          OutputExists: a result exists, and `force` is not given.
          UnsafeOutput: a path leaves the folder, goes through a link, is an input, or is listed twice.
          UnwritableOutput: the system does not allow to write it.
        """
        with failures_of(self.folder):
            there = _nearest_folder(self.folder)
            for path in paths:
                self._refuse_outside(path)
                _refuse_long_names(path, os.pathconf(there, "PC_NAME_MAX"))
                self._refuse_what_stands(path)
        for path in {path for path in paths if paths.count(path) > 1}:
            raise UnsafeOutput(f"{path}: two results would have this path; give them different names")

    def _refuse_outside(self, path: Path) -> None:
        inside = path.is_relative_to(self.folder) and path != self.folder
        if not inside or ".." in path.relative_to(self.folder).parts:
            raise UnsafeOutput(f"{path}: outside of {self.folder}, where results go; give a plain name")

    def _refuse_what_stands(self, path: Path) -> None:
        """Check each folder on the way, then the path itself."""
        parts = path.relative_to(self.folder).parts
        for i in range(1, len(parts) + 1):
            place = self.folder.joinpath(*parts[:i])
            found = _status(place)
            if found is None:
                return
            if stat.S_ISLNK(found.st_mode):
                raise UnsafeOutput(
                    f"{place}: is a link, and results are never written through one; remove it, or give "
                    "another folder"
                )
            if place != path:
                self._refuse_folder(place, found)
            else:
                self._refuse_existing(path, found)

    def _refuse_folder(self, place: Path, found: os.stat_result) -> None:
        _refuse_unwritable(place)
        if found.st_dev != self.folder.stat().st_dev:
            raise UnwritableOutput(
                f"{place}: on another disk than {self.folder}; give a folder that is on one disk"
            )

    def _refuse_existing(self, path: Path, found: os.stat_result) -> None:
        for own in self.inputs:
            if own.exists() and os.path.samestat(own.stat(), found):
                raise UnsafeOutput(
                    f"{path}: the same file as {own}, which this run reads; give another folder"
                )
        if not self.force:
            raise OutputExists(f"{path} exists; give another path, or --force to replace it")
        if not stat.S_ISREG(found.st_mode):
            raise UnsafeOutput(f"{path}: is not a file, and --force only replaces files; remove it")


def _nearest_folder(folder: Path) -> Path:
    """The folder, or the nearest existing one above it; checked to be writable."""
    if "\0" in str(folder):
        raise UnwritableOutput(f"{str(folder)!r}: a path cannot hold the character NUL; leave it out")
    for place in (folder, *folder.parents):
        if _status(place) is not None:
            if not place.exists():
                raise UnwritableOutput(
                    f"{place}: is a link to something that does not exist; give another folder"
                )
            _refuse_unwritable(place)
            return place
    return Path()


def _refuse_unwritable(place: Path) -> None:
    if not place.is_dir():
        raise UnwritableOutput(f"{place}: is a file, but a folder is needed; give another folder")
    if not os.access(place, os.W_OK | os.X_OK):
        raise UnwritableOutput(f"{place}: you may not write here; give another folder")


def _refuse_long_names(path: Path, longest: int) -> None:
    """Refuse names that are too long: the system reports them only if all folders on the way exist."""
    for part in path.parts:
        if len(os.fsencode(part)) > longest:
            raise UnwritableOutput(f"{path}: a name of more than {longest} bytes; give a shorter one")


def _status(path: Path) -> os.stat_result | None:
    """Status of a path, links not followed; None: nothing is there."""
    if "\0" in str(path):
        raise UnwritableOutput(f"{str(path)!r}: a path cannot hold the character NUL; leave it out")
    try:
        return path.lstat()
    except FileNotFoundError:
        return None
