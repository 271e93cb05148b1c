"""Diagnoses every log of a folder, two at a time, without reading the ground truth.

Reports that exist are kept: a run that was stopped continues where it was.
"""

import json
import time
from collections.abc import Callable, Iterable, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import replace
from pathlib import Path
from typing import Any

from diagnosis.log.rig_log import read_rig_log
from diagnosis.pipeline import diagnose
from diagnosis.report.json_report import as_json
from models.errors import NeedleError
from sim.files import write_text


def diagnose_all(
    logs: Path,
    reports: Path,
    *,
    workers: int = 2,
    trials: int | None = None,
    limit_s: float | None = None,
    watched: Callable[[Sequence[Any]], Iterable[Any]] = iter,
) -> None:
    """Write `reports/<case>.json` for every folder in `logs`.

    Args:
      trials: number of trials to use of every log, the first ones; None: all.
      limit_s: time for each diagnosis; None: no limit.
      watched: iterates over the tasks, and may show progress.
    """
    missing = [case for case in sorted(logs.iterdir()) if not (reports / f"{case.name}.json").exists()]
    with ProcessPoolExecutor(workers) as pool:
        how: dict[str, Any] = {"trials": trials, "limit_s": limit_s}
        tasks = [pool.submit(_one, case, reports / f"{case.name}.json", **how) for case in missing]
        for task in watched(tasks):
            task.result()


def _one(case: Path, path: Path, *, trials: int | None, limit_s: float | None) -> None:
    limit: dict[str, Any] = {} if limit_s is None else {"limit_s": limit_s}
    start = time.perf_counter()
    try:
        log = read_rig_log(case)
        report = as_json(diagnose(replace(log, trials=log.trials[:trials]), workers=1, **limit))
    except NeedleError as error:
        report = {"verdict": "refused", "effects": [], "why": str(error)}
    report["seconds"] = time.perf_counter() - start
    write_text(path, json.dumps(report, indent=1), force=True)
