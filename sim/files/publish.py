"""A set of results that becomes the result as one: all of it, or what was there before."""

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
    """Where the files of one result are written before they get their names.

    Attributes:
      paths: of all results.
      left_out: those that could not be made, with the reason; the others stand without them.
      lacks: parts that could not be made of results that are there, with the reason.
    """

    def __init__(self, folder: Path, paths: Sequence[Path], part: Path) -> None:
        """The results of a folder, now in the folder of a run."""
        self.paths, self.left_out = tuple(paths), dict[Path, str]()
        self.lacks = dict[Path, tuple[str, ...]]()
        self._folder, self._part = folder, part

    @property
    def made(self) -> list[Path]:
        """Results that are there, or will be."""
        return [path for path in self.paths if path not in self.left_out]

    def at(self, path: Path) -> Path:
        """Where to write now what will be `path`."""
        place = self._part / RESULTS / path.relative_to(self._folder)
        place.parent.mkdir(parents=True, exist_ok=True)
        return place

    def optional(self, path: Path, write: Callable[[Path], object]) -> None:
        """Write what is for looking at, after all results that others are computed from.

        Where it fails the results stand without it. A disk that is full is no such failure.

        Raises:
          OSError: the disk is at fault, not the picture.
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
        """Give the files their names; `check` is asked once no other run can interfere."""
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
    """A file, or a folder with all that is in it, and the folders that list them."""
    for folder, _, files in os.walk(path):
        for name in (*files, "."):
            on_disk(Path(folder, name))
    if not path.is_dir():
        on_disk(path)
    on_disk(path.parent)


@contextmanager
def publishing(destination: Destination, paths: Sequence[Path]) -> Iterator[ResultSet]:
    """A set of files that become the results when the block ends well; else nothing changes.

    Args:
      paths: all results, files or new folders, inside the destination's folder. Each is written in
        the block, or is optional and fails.

    Raises:
      OutputExists, UnsafeOutput: a result may not be written there.
      UnwritableOutput: the disk is full, or something else that the system says.
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
    """Remove what came to no result; what is decided is for the next run to finish."""
    if not decided(part):
        shutil.rmtree(part, ignore_errors=True)
