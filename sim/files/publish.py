"""A set of results that is published as a whole: either all of it, or what was there before."""

import os
import shutil
import tempfile
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import ExitStack, contextmanager
from pathlib import Path

from models.errors import UnwritableOutput
from sim.files.destination import Destination
from sim.files.failures import failures_of, is_of_the_place
from sim.files.journal import PREFIX, RESULTS, Journal, decide, decided, finish, on_disk, sweep
from sim.files.locks import holding, left_alone


class ResultSet:
    """The files of one result, written to a temporary folder before they get their final names.

    Attributes:
      paths: final paths of all results.
      left_out: optional results that could not be made, with the reason.
      lacks: results of which parts could not be made, with the reasons.
    """

    def __init__(self, folder: Path, paths: Sequence[Path], part: Path) -> None:
        """`folder`: of the results; `part`: temporary folder of the run."""
        self.paths, self.left_out = tuple(paths), dict[Path, str]()
        self.lacks = dict[Path, tuple[str, ...]]()
        self._folder, self._part = folder, part

    @property
    def made(self) -> list[Path]:
        """All results but those that were left out."""
        return [path for path in self.paths if path not in self.left_out]

    def at(self, path: Path) -> Path:
        """The temporary path of what will be `path`."""
        place = self._part / RESULTS / path.relative_to(self._folder)
        place.parent.mkdir(parents=True, exist_ok=True)
        return place

    def optional(self, path: Path, write: Callable[[Path], object]) -> None:
        """Write a result that is only for display, such as a picture; call it after all numbers.

        If `write` fails, the other results are published without it. A full disk is an error, however.

        Raises:
          OSError: the disk is at fault, not the content.
        """
        draft = self.at(path)
        try:
            write(draft)
        except Exception as error:
            if is_of_the_place(error) or isinstance(error, UnwritableOutput):
                raise
            draft.unlink(missing_ok=True)
            self.left_out[path] = f"{type(error).__name__}: {error}"

    def become(self, check: Callable[[], None]) -> None:
        """Give the files their names; `check` is called once no other run can interfere."""
        for path in self.made:
            _all_on_disk(self.at(path))
        with holding(self._folder):
            sweep(self._folder)
            check()
            place, remove = (self._names(own) for own in (self.made, self.left_out))
            decide(self._part, Journal(place=place, remove=remove))
            try:
                finish(self._part)
            except BaseException:  # Ctrl-C comes when it likes, and what is decided gets done
                finish(self._part)
                raise

    def _names(self, paths: Iterable[Path]) -> tuple[str, ...]:
        return tuple(str(path.relative_to(self._folder)) for path in paths)


def _all_on_disk(path: Path) -> None:
    """Flush a file, or a folder with all its content, and the folders that contain them."""
    for folder, _, files in os.walk(path):
        for name in (*files, "."):
            on_disk(Path(folder, name))
    if not path.is_dir():
        on_disk(path)
    on_disk(path.parent)


@contextmanager
def publishing(destination: Destination, paths: Sequence[Path]) -> Iterator[ResultSet]:
    """A set of files that are published when the block ends without an error; else nothing changes.

    Args:
      paths: all results, files or new folders, inside the destination's folder. The block has to
        write each of them, except optional ones that fail.

    Raises:
      OutputExists, UnsafeOutput: a result may not be written there.
      UnwritableOutput: the disk is full, or the system reports another error.
    """
    destination.check(paths)
    folder = destination.folder
    with failures_of(folder), ExitStack() as run:
        folder.mkdir(parents=True, exist_ok=True)
        with holding(folder):
            sweep(folder)
            part = Path(tempfile.mkdtemp(prefix=PREFIX, dir=folder))
            run.callback(_abandon, part)
            run.enter_context(left_alone(part))
        results = ResultSet(folder, paths, part)
        yield results
        results.become(lambda: destination.check(paths))


def _abandon(part: Path) -> None:
    """Remove the files of a failed run; after the commit, leave them to the next run."""
    if not decided(part):
        shutil.rmtree(part, ignore_errors=True)
