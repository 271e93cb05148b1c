"""Diagnoses every log of a folder, two at a time, without reading the ground truth.

Reports that exist are kept: a run that was stopped continues where it was.
"""

import json
import time
from dataclasses import replace
from pathlib import Path
from typing import Any

import pandas as pd

from diagnosis.log.rig_log import read_rig_log
from diagnosis.pipeline import diagnose
from diagnosis.report.json_report import as_json
from diagnosis.workers import Heard, Task, process_pool, unheard
from models.errors import NeedleError
from sim.files import Destination, write_text
from validation.score.answers import read_answers
from validation.score.scores import read_scores, reports_in


def score_logs(
    folder: Path,
    *,
    workers: int = 2,
    trials: int | None = None,
    limit_s: float | None = None,
    progress: Heard = unheard,
) -> pd.DataFrame:
    """Diagnose the logs of a folder that have no report yet, then compare with the ground truth.

    Args:
      folder: with `logs/` and `answers/`, as `make_logs` writes them.
      trials, limit_s, progress: as of `diagnose_all`.

    Returns:
      One row per log, as `read_scores`.

    Raises:
      InvalidValue: the ground truth is unusable; that is seen before anything is diagnosed.
    """
    read_answers(folder)  # checked before the diagnosis, which takes long and never sees them
    diagnose_all(
        folder / "logs",
        reports_in(folder, trials, limit_s),
        workers=workers,
        trials=trials,
        limit_s=limit_s,
        progress=progress,
    )
    return read_scores(folder, trials, limit_s)


def diagnose_all(
    logs: Path,
    reports: Path,
    *,
    workers: int = 2,
    trials: int | None = None,
    limit_s: float | None = None,
    progress: Heard = unheard,
) -> None:
    """Write `reports/<case>.json` for every folder in `logs`.

    Args:
      trials: number of trials to use of every log, the first ones; None: all.
      limit_s: time for each diagnosis; None: no limit.
      progress: is told how many logs are done.

    Raises:
      UnsafeOutput, UnwritableOutput: a report may not or cannot be written; those before it stay.
    """
    paths = {case: reports / f"{case.name}.json" for case in sorted(logs.iterdir())}
    missing = {case: path for case, path in paths.items() if not path.exists()}
    Destination(folder=reports.parent, inputs=tuple(logs.rglob("*"))).check([*missing.values()])
    tasks = [Task(effects=(), arguments=(*pair, trials, limit_s)) for pair in missing.items()]
    with process_pool(workers, progress) as pool:
        pool.each("diagnosing logs", _one, tasks)


def _one(case: Path, path: Path, trials: int | None, limit_s: float | None) -> None:
    limit: dict[str, Any] = {} if limit_s is None else {"limit_s": limit_s}
    start = time.perf_counter()
    try:
        log = read_rig_log(case)
        report = as_json(diagnose(replace(log, trials=log.trials[:trials]), workers=1, **limit))
    except NeedleError as error:
        report = {"verdict": "refused", "effects": [], "why": str(error)}
    report["seconds"] = time.perf_counter() - start
    write_text(path, json.dumps(report, indent=1), force=True)
