"""Writing an imported log, and never over a file of the user's."""

from collections.abc import Sequence
from pathlib import Path

import pandas as pd
import yaml

from diagnosis.lab_files.mapping import ImportMapping, as_rig
from diagnosis.lab_files.readers.lab_table import LabFile
from diagnosis.lab_files.series import refuse_unreadable
from diagnosis.lab_files.trial_tables import ImportedTrial, imported_trial
from models.errors import InvalidValue
from sim.files import refuse_existing, write_text, writing

_DIGITS = "%.9g"


def imported(mapping: ImportMapping, files: Sequence[LabFile]) -> tuple[ImportedTrial, ...]:
    """All trials of a mapping.

    Raises:
      InvalidValue: names the file and column.
    """
    refuse_unreadable(mapping, files)
    return tuple(imported_trial(mapping, trial, files) for trial in mapping.trials)


def log_paths(mapping: ImportMapping, folder: Path) -> list[Path]:
    """What `write_log` writes."""
    return [folder / "rig.yaml", *(folder / trial.file for trial in mapping.trials)]


def refuse_to_overwrite(paths: Sequence[Path], inputs: Sequence[Path], *, force: bool) -> None:
    """Check, before anything is written, that no input would be replaced: not even by `--force`.

    Raises:
      InvalidValue: an output is one of the inputs.
      OutputExists: an output exists and `force` is not given.
    """
    for path in paths:
        for own in inputs:
            if path.exists() and own.exists() and path.samefile(own):
                raise InvalidValue(
                    "--out", path, "a folder where nothing replaces an input", "give another folder"
                )
    refuse_existing(list(paths), force=force)


def write_log(
    mapping: ImportMapping, trials: Sequence[ImportedTrial], folder: Path, *, force: bool
) -> None:
    """Write `rig.yaml` and one CSV per trial."""
    for trial in trials:
        with writing(folder / trial.name, force=force) as part:
            pd.DataFrame(trial.table).to_csv(part, index=False, float_format=_DIGITS)
    sources = "; ".join(f"{t.file} from {', '.join(t.lab_files)}" for t in mapping.trials)
    head = f"# Made by needle import: {' '.join(sources.split())}\n"
    content = yaml.safe_dump(as_rig(mapping), sort_keys=False, allow_unicode=True)
    write_text(folder / "rig.yaml", head + content, force=force)
