"""Imports a lab's files as a log, in one call, as `needle import --map` does."""

from collections.abc import Sequence
from pathlib import Path

from diagnosis.lab_files.read_mapping import read_mapping
from diagnosis.lab_files.readers.read import read_lab_files
from diagnosis.lab_files.write_log import imported, log_paths, write_log
from diagnosis.log.rig_log import RigLog, read_rig_log
from sim.files import Destination


def import_log(
    files: Sequence[Path],
    mapping: Path,
    folder: Path,
    *,
    accept_guesses: bool = False,
    force: bool = False,
) -> RigLog:
    """Write files as a rig-log/1 folder by a confirmed mapping, and read that.

    Args:
      files: CSV or other text, Parquet, MAT, MCAP.
      mapping: a `mapping.yaml`, as `needle import` drafts it.
      folder: where `rig.yaml` and the trials are written.
      accept_guesses: treat the guesses of a draft as confirmed.
      force: replace a log that exists; an input is never replaced.

    Raises:
      InvalidValue: names the file, the column, or blanks of the mapping.
      OutputExists: a file exists and `force` is not given.
      UnsafeOutput, UnwritableOutput: the log may not or cannot be written there.
      UnusableLog: the log cannot be used.
    """
    told, lab_files = read_mapping(mapping, accept_guesses=accept_guesses), read_lab_files(files)
    destination = Destination(folder=folder, inputs=(mapping, *files), force=force)
    destination.check(log_paths(told, folder))
    write_log(told, imported(told, lab_files), destination)
    return read_rig_log(folder)
