"""Diagnoses every log of a folder, without reading the ground truth.

An engine runs the diagnoses, on this machine or on a cluster. Each report is written as soon as it is
done, and existing ones are kept: an interrupted run continues where it stopped.
"""

import json
import time
from dataclasses import replace
from pathlib import Path
from typing import Any

import pandas as pd
from numpy.linalg import LinAlgError

from diagnosis.engines.engine import Engine, Job
from diagnosis.engines.local import on_this_machine
from diagnosis.log.rig_log import read_rig_log
from diagnosis.pipeline import diagnose
from diagnosis.report.json_report import as_json
from diagnosis.workers import Heard, unheard
from models.errors import NeedleError
from sim.files import Destination, write_text
from validation.score.answers import read_answers
from validation.score.scores import read_scores, reports_in

_STAGE = "diagnosing logs"


def score_logs(
    folder: Path,
    *,
    workers: int = 2,
    engine: Engine | None = None,
    trials: int | None = None,
    limit_s: float | None = None,
    progress: Heard = unheard,
) -> pd.DataFrame:
    """Diagnose the logs of a folder that have no report yet, then compare with the ground truth.

    Args:
      folder: with `logs/` and `answers/`, as `make_logs` writes them.
      workers, engine, trials, limit_s, progress: as in `diagnose_all`.

    Returns:
      One row per log, as `read_scores`.

    Raises:
      InvalidValue: the ground truth is unusable; this is checked before any diagnosis.
      EngineFailed: no worker is left; reports that were written are kept.
    """
    read_answers(folder)  # checked before the diagnosis, which takes long and never sees them
    diagnose_all(
        folder / "logs",
        reports_in(folder, trials, limit_s),
        workers=workers,
        engine=engine,
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
    engine: Engine | None = None,
    trials: int | None = None,
    limit_s: float | None = None,
    progress: Heard = unheard,
) -> None:
    """Write `reports/<case>.json` for every folder in `logs`.

    Args:
      workers: number of processes on this machine.
      engine: replaces them; workers of a cluster need the logs at the same paths as here.
      trials: use only so many first trials of every log; None: all.
      limit_s: time limit of each diagnosis, s; None: no limit.
      progress: called with the number of logs that are done.

    Raises:
      UnsafeOutput, UnwritableOutput: a report may not or cannot be written; earlier ones are kept.
      EngineFailed: no worker is left; reports that were written are kept.
    """
    paths = {str(case.resolve()): reports / f"{case.name}.json" for case in sorted(logs.iterdir())}
    missing = {case: path for case, path in paths.items() if not path.exists()}
    Destination(folder=reports.parent, inputs=tuple(logs.rglob("*"))).check([*missing.values()])
    job = Job(function=f"{__name__}.{report_of.__name__}", arguments=(trials, limit_s), noun="log")
    diagnosed = (engine or on_this_machine(workers))(job, list(missing))
    progress(_STAGE, 0, len(missing))
    for done, (case, report) in enumerate(diagnosed, start=1):
        write_text(missing[str(case)], json.dumps(report, indent=1), force=True)
        progress(_STAGE, done, len(missing))


def report_of(trials: int | None, limit_s: float | None, case: str) -> dict[str, Any]:
    """The report of a log as in `report.json`, with `seconds`; of a refused log the reason, `why`."""
    limit: dict[str, Any] = {} if limit_s is None else {"limit_s": limit_s}
    start = time.perf_counter()
    try:
        log = read_rig_log(Path(case))
        report = as_json(diagnose(replace(log, trials=log.trials[:trials]), workers=1, **limit))
    except (NeedleError, ArithmeticError, LinAlgError) as error:
        report = {"verdict": "refused", "effects": [], "why": str(error)}
    return report | {"seconds": time.perf_counter() - start}
