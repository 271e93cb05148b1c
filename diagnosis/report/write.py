"""A diagnosis as files: `report.json`, `report.html`, `gap.rrd`, `predictions/` (gap-report/1)."""

import json
from collections.abc import Iterator
from pathlib import Path

import pandas as pd

from diagnosis.log.rig_log import RigLog
from diagnosis.log.trial import SENSORS
from diagnosis.report.fallible import write_page
from diagnosis.report.html_report import page
from diagnosis.report.json_report import as_json
from diagnosis.report.recording import log_gap
from diagnosis.report.sentences import headline
from diagnosis.result import Diagnosis
from sim.files import Destination, ResultSet, publishing, write_text


def output_paths(log: RigLog, folder: Path) -> list[Path]:
    """What `write_report` will write."""
    whole = [folder / name for name in ("report.json", "report.html", "gap.rrd")]
    return [*whole, *(folder / "predictions" / t.name for t in log.trials)]


def write_report(diagnosis: Diagnosis, destination: Destination) -> ResultSet:
    """Write everything as one, the numbers first: a page or recording that fails is left out, and
    of a page the pictures that fail.

    Raises:
      OutputExists, UnsafeOutput, UnwritableOutput: nothing is written.
    """
    paths = output_paths(diagnosis.log, destination.folder)
    report = as_json(diagnosis)
    with publishing(destination, paths) as results:
        told, shown, recording, *predictions = paths
        write_text(results.at(told), json.dumps(report, indent=1, allow_nan=False))
        for path, table in zip(predictions, _predictions(diagnosis), strict=True):
            write_text(results.at(path), table.to_csv(index=False, float_format="%.6g"))
        write_page(lambda: page(diagnosis, report), results, shown)
        results.optional(recording, lambda part: log_gap(diagnosis, headline(diagnosis), part))
    return results


def _predictions(diagnosis: Diagnosis) -> Iterator[pd.DataFrame]:
    explained = diagnosis.assessment.explained
    each = zip(diagnosis.log.trials, diagnosis.nominal, explained, strict=True)
    for trial, before, after in each:
        rows = trial.file_rows
        nominal, best = (p.at(rows.taken_s, trial["time_s"]) for p in (before, after))
        columns = {"time_s": rows.stamps_s}
        for sensor in SENSORS:
            columns[f"{sensor}_nominal"] = nominal[sensor]
            columns[f"{sensor}_explained"] = best[sensor]
        yield pd.DataFrame(columns)
