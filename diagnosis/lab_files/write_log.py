"""Writes an imported log."""

from collections.abc import Sequence
from pathlib import Path
from tempfile import TemporaryDirectory

import pandas as pd
import yaml

from diagnosis.lab_files.mapping import ImportMapping, as_rig
from diagnosis.lab_files.readers.lab_table import LabFile
from diagnosis.lab_files.runs import each_run
from diagnosis.lab_files.series import refuse_unreadable
from diagnosis.lab_files.trial_tables import ImportedTrial, imported_trial
from diagnosis.log.rig_log import RigLog, read_rig_log
from diagnosis.log.trial import UnusableLog
from sim.files import Destination, ResultSet, publishing, write_text

_DIGITS = "%.9g"


def imported(mapping: ImportMapping, files: Sequence[LabFile]) -> tuple[ImportedTrial, ...]:
    """All trials of a mapping.

    Raises:
      InvalidValue: names the file and column.
    """
    files = (*files, *each_run(files))
    refuse_unreadable(mapping, files)
    return tuple(imported_trial(mapping, trial, files) for trial in mapping.trials)


def log_paths(mapping: ImportMapping, folder: Path) -> list[Path]:
    """All files that `write_log` writes."""
    return [folder / "rig.yaml", *(folder / trial.file for trial in mapping.trials)]


def read_back(mapping: ImportMapping, trials: Sequence[ImportedTrial]) -> RigLog:
    """The log as it will be read, from a temporary folder, before anything is written where it belongs.

    Raises:
      UnusableLog: it is refused as a log.
    """
    with TemporaryDirectory() as folder:
        write_log(mapping, trials, Destination(folder=Path(folder)))
        try:
            return read_rig_log(Path(folder))
        except UnusableLog as refused:
            reason = str(refused).replace(f"{folder}/", "")
            raise UnusableLog(
                f"nothing was written, since this log would be refused; correct the column's unit, sign "
                f"or zero in the mapping (or 'unwrap: true'), or its file: {reason}"
            ) from refused


def write_log(
    mapping: ImportMapping, trials: Sequence[ImportedTrial], destination: Destination
) -> ResultSet:
    """Write one CSV per trial and `rig.yaml`, as one set.

    Raises:
      OutputExists, UnsafeOutput, UnwritableOutput: nothing is written.
    """
    folder = destination.folder
    with publishing(destination, log_paths(mapping, folder)) as results:
        for trial in trials:
            table = pd.DataFrame(trial.table)
            table.to_csv(results.at(folder / trial.name), index=False, float_format=_DIGITS)
        sources = "; ".join(f"{t.file} from {', '.join(t.lab_files)}" for t in mapping.trials)
        head = f"# Made by needle import: {' '.join(sources.split())}\n"
        content = yaml.safe_dump(as_rig(mapping), sort_keys=False, allow_unicode=True)
        write_text(results.at(folder / "rig.yaml"), head + content)
    return results
