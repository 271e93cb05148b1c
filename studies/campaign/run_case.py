"""Runs cases; each gives a row of results."""

import json
from collections.abc import Callable, Mapping, Sequence
from functools import lru_cache, partial
from pathlib import Path
from typing import Any

import mujoco
import numpy as np
from numpy.linalg import LinAlgError
from numpy.typing import NDArray

from diagnosis.engines.engine import Job
from diagnosis.log.rig_log import read_rig_log
from diagnosis.pipeline import diagnose
from diagnosis.report.json_report import as_json
from models.errors import NeedleError
from sim.batch import simulate_each
from sim.experiment import checked_error_deg
from sim.needles.run import Run
from sim.protocol import Protocol
from sim.simulation import prepare_processes
from studies.campaign.campaign import Campaign, Kind
from studies.campaign.cases import Case, cases_of
from studies.campaign.columns import DONE, FAILED, Row
from studies.campaign.posterior.drawn_rig import DrawnRig, drawn_rig, tip_error_deg
from studies.control.closed_loop_run import perform_closed_loop

Array = NDArray[np.float64]
Attempt = dict[str, Any] | Exception
"""Results by name, or why there are none."""

_EXPECTED = (NeedleError, mujoco.FatalError, ArithmeticError, LinAlgError)


def job_of(campaign: Campaign) -> Job:
    """The job of an engine: rows of pieces. The campaign is sent as text."""
    function = f"{rows_of_text.__module__}.{rows_of_text.__name__}"
    return Job(function=function, arguments=(campaign.model_dump_json(),), noun="cases")


def rows_of_text(text: str, numbers: Sequence[int]) -> list[Row]:
    """Rows of a campaign that is given as JSON."""
    return rows_of(_campaign(text), numbers)


@lru_cache(maxsize=1)
def _campaign(text: str) -> Campaign:
    return Campaign(**json.loads(text))


def rows_of(campaign: Campaign, numbers: Sequence[int]) -> list[Row]:
    """Run cases, in one process and one thread: one row each, in their order.

    A case that fails gives a row with its error; an error of the program is raised.
    """
    prepare_processes()
    cases = cases_of(campaign, numbers)
    attempts = {
        Kind.INSERTION: _insertions,
        Kind.CONTROL: _controlled,
        Kind.DIAGNOSIS: _diagnosed,
        Kind.POSTERIOR: _drawn_rigs,
    }[campaign.kind](campaign, cases)
    return [_row(case, attempt) for case, attempt in zip(cases, attempts, strict=True)]


def _row(case: Case, attempt: Attempt) -> Row:
    failed = isinstance(attempt, Exception)
    status = {"status": FAILED, "error": str(attempt)} if failed else {"status": DONE, "error": None}
    results = {} if isinstance(attempt, Exception) else attempt
    varied = {path: _plain(value) for path, value in case.varied.items()}
    return {"case": case.number, **status, **varied, **results}


def _plain(value: Any) -> Any:
    return json.dumps(value) if isinstance(value, dict | list | tuple) else value


def _attempt(case: Case, run: Callable[[], dict[str, Any]]) -> Attempt:
    """Results of one case, or the reason why it failed."""
    if case.refused:
        return case.refused
    try:
        return run()
    except _EXPECTED as failed:
        return failed


def _insertions(campaign: Campaign, cases: Sequence[Case]) -> list[Attempt]:
    return _simulated(cases, {case.number: case.protocol for case in cases if case.protocol})


def _drawn_rigs(campaign: Campaign, cases: Sequence[Case]) -> list[Attempt]:
    posterior, motion = campaign.posterior, campaign.base
    if posterior is None or motion is None:
        return []
    return _simulated(cases, {c.number: drawn_rig(posterior, motion, c.varied) for c in cases})


def _simulated(
    cases: Sequence[Case], insertions: Mapping[int, Protocol] | Mapping[int, DrawnRig]
) -> list[Attempt]:
    """Results of cases that are insertions, simulated together."""
    runs = simulate_each(list(insertions.values()), threads=1)
    found = dict(zip(insertions, runs, strict=True))

    def results(case: Case) -> dict[str, Any]:
        run, insertion = found[case.number], insertions[case.number]
        if isinstance(run, NeedleError):
            raise run
        if isinstance(insertion, DrawnRig):
            return drawn_rig_results(run, insertion)
        return insertion_results(run, insertion)

    return [_attempt(case, partial(results, case)) for case in cases]


def drawn_rig_results(run: Run, drawn: DrawnRig) -> dict[str, Any]:
    """Results of a run of a drawn rig; the base angle is the one that its encoder shows."""
    summed_up = _summed_up(
        time_s=run.time_s,
        base_deg=drawn.wanted_deg(run.time_s),
        tip_deg=run.tip_deg,
        torque_n_mm=run.base_torque_n_mm,
        unconverged=run.unconverged,
    )
    return summed_up | {"tip_error_deg": tip_error_deg(drawn, run).tolist()}


def insertion_results(run: Run, protocol: Protocol | None = None) -> dict[str, Any]:
    """Results of a run of a protocol.

    Raises:
      InvalidValue: the step causes more error than the protocol allows.
    """
    if protocol and protocol.accuracy_deg is not None:
        checked_error_deg(protocol, run)
    return _summed_up(
        time_s=run.time_s,
        base_deg=run.shaft_deg,
        tip_deg=run.tip_deg,
        torque_n_mm=run.base_torque_n_mm,
        unconverged=run.unconverged,
    )


def _summed_up(
    *, time_s: Array, base_deg: Array, tip_deg: Array, torque_n_mm: Array, unconverged: int
) -> dict[str, Any]:
    lag = np.abs(base_deg - tip_deg)
    return {
        "largest_lag_deg": float(lag.max()),
        "largest_lag_time_s": float(time_s[lag.argmax()]),
        "end_lag_deg": float(lag[-1]),
        "largest_base_torque_n_mm": float(np.abs(torque_n_mm).max()),
        "end_tip_deg": float(tip_deg[-1]),
        "unconverged_count": unconverged,
    }


def _controlled(campaign: Campaign, cases: Sequence[Case]) -> list[Attempt]:
    return [_attempt(case, partial(_control_results, campaign, case)) for case in cases]


def _control_results(campaign: Campaign, case: Case) -> dict[str, Any]:
    if case.protocol is None or campaign.controller is None:
        return {}
    recording = perform_closed_loop(case.protocol, campaign.controller)
    tip_deg = recording["tip_angle_deg"]
    return _summed_up(
        time_s=recording["time_s"],
        base_deg=recording["base_angle_deg"],
        tip_deg=tip_deg,
        torque_n_mm=recording["base_torque_n_mm"],
        unconverged=int(recording["unconverged_count"][-1]),
    ) | {
        "end_tip_error_deg": float(np.abs(recording["wanted_tip_deg"] - tip_deg)[-1]),
        "largest_estimate_error_deg": float(np.abs(recording["estimate_tip_deg"] - tip_deg).max()),
    }


def _diagnosed(campaign: Campaign, cases: Sequence[Case]) -> list[Attempt]:
    return [_attempt(case, partial(_diagnosis_results, campaign, case)) for case in cases]


def _diagnosis_results(campaign: Campaign, case: Case) -> dict[str, Any]:
    log = read_rig_log(Path(case.log or ""))
    report = as_json(diagnose(log, workers=1, limit_s=campaign.limit_s))
    return {
        "log": case.log,
        "verdict": report["verdict"],
        "effects": " + ".join(report["effects"]),
        "gap_before": report["gap"]["before"],
        "gap_after": report["gap"]["after"],
        "probability": report["ranking"][0]["probability"] if report["ranking"] else None,
    }
