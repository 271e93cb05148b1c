"""The output folder: the given one, or a default one in which nothing is overwritten."""

import re
from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack
from itertools import count
from pathlib import Path

from models.errors import OutputExists
from sim.files import Destination, claiming, finish_interrupted

Outputs = Callable[[Path], list[Path]]
"""The files that will be written, given the folder."""

_CLAIMS = ExitStack()
"""Of the default folders that this process has chosen: no other run chooses them meanwhile."""


def output_folder(
    given: Path | None, default: Path, outputs: Outputs, *, force: bool, inputs: Sequence[Path] = ()
) -> Destination:
    """The folder to write to, chosen and checked before anything is computed.

    Args:
      given: by the user; None: the default, or the first numbered one without earlier results
        (`out/control`, `out/control-2`, ...); with `force` the default itself.
      inputs: files that the run reads.

    Raises:
      OutputExists: a result exists in the given folder, and `force` is not given.
      UnsafeOutput, UnwritableOutput: a result may not or cannot be written there.
    """
    folder = given or (default if force else first_free(default, outputs))
    destination = Destination(folder=folder, inputs=tuple(inputs), force=force)
    destination.check(outputs(folder))
    return destination


def first_free(default: Path, outputs: Outputs) -> Path:
    """The default, or the first numbered folder that has no results and is used by no other run.

    It is reserved for this run until `release_folders`.

    Raises:
      UnwritableOutput: nothing can be written there.
    """
    return next(folder for folder in _numbered(default) if _is_free(folder, outputs))


def latest(default: Path, begun_at: Callable[[Path], float | None]) -> Path:
    """The default or numbered folder with the latest start of a run; the default if there is none.

    It is reserved for this run until `release_folders`.

    Args:
      begun_at: time at which a run was started in a folder, in any unit; None: never.

    Raises:
      OutputExists: another run uses it.
      UnwritableOutput: nothing can be written there.
    """
    begun = {folder: begun_at(folder) for folder in _existing(default)}
    times = {folder: time for folder, time in begun.items() if time is not None}
    folder = max(times, key=lambda one: times[one], default=default)
    if not _CLAIMS.enter_context(claiming(folder)):
        raise OutputExists(f"{folder}: another run works in it; wait until it has ended")
    return folder


def release_folders() -> None:
    """Release the folders that this process has reserved; to be called at its end."""
    _CLAIMS.close()


def _is_free(folder: Path, outputs: Outputs) -> bool:
    with ExitStack() as claim:
        if claim.enter_context(claiming(folder)) and not _has_results(folder, outputs):
            _CLAIMS.enter_context(claim.pop_all())
            return True
    return False


def _has_results(folder: Path, outputs: Outputs) -> bool:
    finish_interrupted(folder)
    return any(path.exists() for path in outputs(folder))


def _existing(default: Path) -> list[Path]:
    """The default and all numbered folders that exist."""
    named = re.compile(re.escape(default.name) + r"(-\d+)?")
    there = default.parent.iterdir() if default.parent.is_dir() else ()
    return [path for path in there if named.fullmatch(path.name)]


def _numbered(default: Path) -> Iterator[Path]:
    yield default
    yield from (default.with_name(f"{default.name}-{i}") for i in count(2))
