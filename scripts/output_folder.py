"""Where results go: the folder that was asked for, or a default one in which nothing is overwritten."""

from collections.abc import Callable, Iterable, Iterator
from itertools import count
from pathlib import Path

from rich.console import Console

from sim.files import refuse_existing

Outputs = Callable[[Path], list[Path]]


def output_folder(given: Path | None, default: Path, outputs: Outputs, *, force: bool) -> Path:
    """The folder to write to, chosen before anything is computed.

    Args:
      given: by the user; None: the default, or the first numbered one without earlier results
        (`out/control`, `out/control-2`, ...); with `force` the default itself.
      outputs: the files that will be written, given the folder.

    Raises:
      OutputExists: a result exists in the folder that was asked for, and `force` is not given.
    """
    folder = given or (default if force else _first_free(default, outputs))
    refuse_existing(outputs(folder), force=force)
    return folder


def say_written(console: Console, written: Iterable[Path | str]) -> None:
    """Name what was written, a line each, which is not broken: it can be copied."""
    for path in written:
        console.print(f"wrote      {path}", highlight=False, markup=False, soft_wrap=True)


def _first_free(default: Path, outputs: Outputs) -> Path:
    return next(f for f in _numbered(default) if not any(path.exists() for path in outputs(f)))


def _numbered(default: Path) -> Iterator[Path]:
    yield default
    yield from (default.with_name(f"{default.name}-{i}") for i in count(2))
