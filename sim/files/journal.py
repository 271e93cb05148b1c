"""The commit of a set of results by a journal, and the recovery after a run that died.

A run writes its files into a folder of its own, `.needle-part-XXXXXXXX`, inside the folder of the
results. Once all of them are on the disk, it writes a journal beside them: which files get their final
names, and which old ones are removed. This commits the new set. If a run dies before, the old set is
unchanged; if it dies after, the next run completes the journal. A live run holds the lock of
its folder, so that no other run removes it.
"""

import os
import re
import shutil
from contextlib import suppress
from pathlib import Path

from pydantic import BaseModel, ConfigDict

from sim.files.destination import Destination
from sim.files.failures import failures_of
from sim.files.locks import holding, left_alone

PREFIX = ".needle-part-"
RESULTS = "results"
_JOURNAL = "journal.json"
_OF_A_RUN = re.compile(re.escape(PREFIX) + r"\w{8}")


class Journal(BaseModel):
    """Files to move into place and old ones to remove, relative to the folder of the results."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    place: tuple[str, ...]
    remove: tuple[str, ...]


def is_of_a_run(name: str) -> bool:
    """Whether this is the name of a folder that a run writes into."""
    return bool(_OF_A_RUN.fullmatch(name))


def on_disk(path: Path) -> None:
    """Flush a file, or the entries of a folder, to the disk.

    Raises:
      OSError: the disk is full or broken.
    """
    handle = os.open(path, os.O_RDONLY)
    try:
        os.fsync(handle)
    finally:
        os.close(handle)


def decide(part: Path, journal: Journal) -> None:
    """Commit the results of a run by writing its journal."""
    draft = part / f"{_JOURNAL}.draft"
    draft.write_text(journal.model_dump_json(), encoding="utf-8")
    on_disk(draft)
    draft.replace(part / _JOURNAL)
    on_disk(part)


def finish(part: Path) -> None:
    """Complete a journal, then remove the folder of the run; may be called again after a failure.

    Raises:
      UnsafeOutput: there is something now that no result may replace.
    """
    journal = decided(part)
    if journal:
        _carry_out(journal, part)
        (part / _JOURNAL).unlink()
    shutil.rmtree(part, ignore_errors=True)


def decided(part: Path) -> Journal | None:
    """The journal of a run; None if it has not committed yet."""
    try:
        return Journal.model_validate_json((part / _JOURNAL).read_text(encoding="utf-8"))
    except (FileNotFoundError, ValueError):
        return None


def _carry_out(journal: Journal, part: Path) -> None:
    folder, drafts = part.parent, part / RESULTS
    left = [name for name in journal.place if (drafts / name).exists()]
    paths = [folder / name for name in (*left, *journal.remove)]
    Destination(folder=folder, force=True).check(paths)
    for name in left:
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (drafts / name).replace(folder / name)
    for name in journal.remove:
        (folder / name).unlink(missing_ok=True)
    for changed in {path.parent for path in paths if path.parent.exists()}:
        on_disk(changed)


def sweep(folder: Path) -> None:
    """Complete the journals of runs that died, and remove what runs left that died before the commit.

    The caller must hold the lock of the folder. Runs of other users are left alone.
    """
    for part in sorted(folder.glob(f"{PREFIX}*")):
        if is_of_a_run(part.name) and part.is_dir() and not part.is_symlink():
            with suppress(FileNotFoundError), left_alone(part) as dead:
                if dead and part.stat().st_uid == os.getuid():
                    finish(part)


def finish_interrupted(folder: Path) -> None:
    """Complete the journal of a run that died; to be called before results of a folder are read.

    Raises:
      UnwritableOutput: the journal cannot be completed.
    """
    if folder.is_dir() and any(is_of_a_run(path.name) for path in folder.glob(f"{PREFIX}*")):
        with failures_of(folder), holding(folder):
            sweep(folder)
