"""A diagnosis as files: `report.json`, `report.html`, `gap.rrd`, `predictions/` (gap-report/1)."""

import json
from collections.abc import Callable, Iterator, Mapping
from functools import partial
from pathlib import Path
from typing import Any

import pandas as pd

from diagnosis.log.rig_log import RigLog
from diagnosis.log.trial import SENSORS
from diagnosis.report.fallible import Page, write_page
from diagnosis.report.json_report import as_json
from diagnosis.report.sentences.verdict import headline
from diagnosis.result import Diagnosis
from diagnosis.workers import Workers, process_pool
from sim.files import Destination, ResultSet, publishing, write_text


def load_libraries() -> None:
    """Import what pages are drawn and recordings made with, which takes 1 to 2 s."""
    from diagnosis.report import html_report, recording  # noqa: F401, PLC0415


def output_paths(log: RigLog, folder: Path) -> list[Path]:
    """What `write_report` will write."""
    whole = [folder / name for name in ("report.json", "report.html", "gap.rrd")]
    return [*whole, *(folder / "predictions" / t.name for t in log.trials)]


def write_report(diagnosis: Diagnosis, destination: Destination, *, workers: int = 2) -> ResultSet:
    """Write everything as one, the numbers first: a page or recording that fails is left out, and
    of a page the pictures that fail.

    Args:
      workers: number of processes that draw the page while this one writes; 1: this one draws, too.

    Raises:
      OutputExists, UnsafeOutput, UnwritableOutput: nothing is written.
    """
    paths = output_paths(diagnosis.log, destination.folder)
    report = as_json(diagnosis)
    with publishing(destination, paths) as results, process_pool(workers) as processes:
        told, shown, recording, *predictions = paths
        page = _page_begun(diagnosis, report, processes)
        write_text(results.at(told), json.dumps(report, indent=1, allow_nan=False))
        for path, table in zip(predictions, _predictions(diagnosis), strict=True):
            write_text(results.at(path), table.to_csv(index=False, float_format="%.6g"))
        results.optional(recording, partial(_record, diagnosis))
        write_page(page, results, shown)
    return results


def _page_begun(diagnosis: Diagnosis, report: Mapping[str, Any], workers: Workers) -> Callable[[], Page]:
    """The page, when it is asked for; a library that is broken is told then and costs the page alone."""
    try:
        from diagnosis.report import html_report  # noqa: PLC0415 - matplotlib takes 0.4 s
    except ImportError as broken:
        return partial(_raise, broken)
    return html_report.page_begun(diagnosis, report, workers)


def _raise(error: Exception) -> Page:
    raise error


def _record(diagnosis: Diagnosis, path: Path) -> None:
    from diagnosis.report.recording import log_gap  # noqa: PLC0415 - rerun takes as long

    log_gap(diagnosis, headline(diagnosis), path)


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
