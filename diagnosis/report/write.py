"""A diagnosis as files: `report.json`, `report.html`, `gap.rrd`, `predictions/` (gap-report/1)."""

import json
from pathlib import Path
from tempfile import TemporaryDirectory

import pandas as pd

from diagnosis.log.rig_log import RigLog
from diagnosis.log.trial import SENSORS
from diagnosis.report.html_report import page
from diagnosis.report.json_report import as_json
from diagnosis.report.recording import log_gap
from diagnosis.report.sentences import headline
from diagnosis.result import Diagnosis
from sim.files import refuse_existing, write_text


def output_paths(log: RigLog, folder: Path) -> list[Path]:
    """What `write_report` will write."""
    whole = [folder / name for name in ("report.json", "report.html", "gap.rrd")]
    return [*whole, *(folder / "predictions" / t.name for t in log.trials)]


def write_report(diagnosis: Diagnosis, folder: Path, *, force: bool = False) -> list[Path]:
    """Write everything, or nothing if it is interrupted; returns the paths.

    Raises:
      OutputExists: one of them exists and `force` is not given.
    """
    paths = output_paths(diagnosis.log, folder)
    refuse_existing(paths, force=force)
    folder.mkdir(parents=True, exist_ok=True)
    with TemporaryDirectory(prefix=".report-", dir=folder) as temporary:
        drafts = output_paths(diagnosis.log, Path(temporary))
        _write_drafts(diagnosis, drafts)
        for draft, path in zip(drafts, paths, strict=True):
            path.parent.mkdir(exist_ok=True)
            draft.replace(path)
    return paths


def _write_drafts(diagnosis: Diagnosis, paths: list[Path]) -> None:
    report = as_json(diagnosis)
    write_text(paths[0], json.dumps(report, indent=1, allow_nan=False))
    write_text(paths[1], page(diagnosis, report))
    log_gap(diagnosis, headline(diagnosis), paths[2])
    _write_predictions(diagnosis, paths[3:])


def _write_predictions(diagnosis: Diagnosis, paths: list[Path]) -> None:
    explained = diagnosis.assessment.explained
    each = zip(diagnosis.log.trials, diagnosis.nominal, explained, paths, strict=True)
    for trial, before, after, path in each:
        rows = trial.file_rows
        nominal, best = (p.at(rows.taken_s, trial["time_s"]) for p in (before, after))
        columns = {"time_s": rows.stamps_s}
        for sensor in SENSORS:
            columns[f"{sensor}_nominal"] = nominal[sensor]
            columns[f"{sensor}_explained"] = best[sensor]
        write_text(path, pd.DataFrame(columns).to_csv(index=False, float_format="%.6g"))
