"""From a log to a diagnosis, stage by stage:

RigLog -> PreparedLog -> FitProblem, fine and coarse -> SearchState -> Verdict -> Assessment -> Diagnosis
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from diagnosis.assessment.assess import assess, at_samples, nominal_residuals
from diagnosis.assessment.identifiability import testable_effects
from diagnosis.effects import library_of
from diagnosis.fitting.decimation import decimated
from diagnosis.fitting.fit import nominal_fit
from diagnosis.fitting.nuisance import nuisance_of
from diagnosis.fitting.problem import FitProblem
from diagnosis.log.checks.noise_claims import far_claims
from diagnosis.log.rig_log import RigLog
from diagnosis.log.trial import SENSORS
from diagnosis.prepare.averaging import averaged
from diagnosis.prepare.prepare import prepare
from diagnosis.prepare.prepared_log import PreparedLog
from diagnosis.prepare.rig_scale import scale_of
from diagnosis.prepare.sensor_noise import estimate_noise
from diagnosis.replay.replay import Prediction, replay
from diagnosis.result import Diagnosis
from diagnosis.selection.checked import check
from diagnosis.selection.contributions import strongest_first
from diagnosis.selection.record import RecordEntry, judged
from diagnosis.selection.search import SearchState, search
from diagnosis.selection.verdict import Verdict, VerdictKind, verdict_on
from diagnosis.workers import Progress, Workers, process_pool, silent
from sim.simulation import prepare_processes

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class NominalReplay:
    """A log beside what its nominal rig predicts: where `needle replay` ends and a diagnosis begins.

    Attributes:
      log: as it is diagnosed: averaged, if it has more samples than are of use.
      problem: the log, its noise, and what is left open of the rig.
      predictions: of the nominal rig, by trial of the problem.
    """

    log: RigLog
    problem: FitProblem
    predictions: list[Prediction]


@dataclass(frozen=True, kw_only=True, eq=False)
class Judged:
    """A verdict, with what it rests on.

    Attributes:
      problem, coarse: with the noise that the best explanation leaves.
      record: of the search and of the verdict.
    """

    problem: FitProblem
    coarse: FitProblem
    verdict: Verdict
    record: tuple[RecordEntry, ...]


def diagnose(log: RigLog, *, workers: int = 2, progress: Progress = silent) -> Diagnosis:
    """Diagnose a log.

    Args:
      workers: processes.
      progress: is told the stage and its share that is done.

    Raises:
      SimulationFailed: the nominal rig cannot be simulated.
    """
    prepare_processes()
    nominal = replay_nominal(log)
    log = nominal.log
    with process_pool(workers, progress) as pool:
        found = _searched(log, nominal, pool)
        last = _judged(found)
        assessment = assess(
            log, last.problem, last.coarse, nominal.predictions, last.verdict, found.effects, pool
        )
    return Diagnosis(
        log=log,
        noise=last.problem.noise,
        nominal=at_samples(last.problem, nominal.predictions),
        verdict=last.verdict,
        assessment=assessment,
        record=last.record,
    )


def replay_nominal(log: RigLog) -> NominalReplay:
    """The nominal rig on a log, with the noise that its residual shows.

    Raises:
      SimulationFailed: the nominal rig cannot be simulated.
    """
    log = averaged(log)
    prepared, base_sigma_deg = prepare(log)
    predictions = replay(prepared)
    told = far_claims(log.trials, log.rig.sensors.by_column())
    noise = estimate_noise(
        log.rig, _residuals(prepared, predictions), base_sigma_deg, told, prepared.rounded
    )
    library = library_of(scale_of(prepared))
    problem = FitProblem(log=prepared, noise=noise, nuisance=nuisance_of(prepared), library=library)
    return NominalReplay(log=log, problem=problem, predictions=predictions)


def _residuals(log: PreparedLog, predictions: Sequence[Prediction]) -> dict[str, list[Array]]:
    """Measured minus nominal, in units of the sensor, by sensor and trial."""
    each = list(zip(log.trials, predictions, strict=True))
    return {s: [t.readings[s] - p[s] for t, p in each if t.has(s)] for s in SENSORS}


def _searched(log: RigLog, nominal: NominalReplay, workers: Workers) -> SearchState:
    """The search for what explains the log."""
    problem = nominal.problem
    start = SearchState(
        problem=problem,
        coarse=decimated(problem, nominal.predictions),
        effects=testable_effects(log),
        nominal=nominal_fit(nominal_residuals(problem, nominal.predictions)),
    )
    return search(start, workers)


def _judged(found: SearchState) -> Judged:
    """The verdict on what the search found."""
    before = found.problem.noise
    checked = check(found.problem, found.candidates, found.checked)
    problem = replace(found.problem, noise=checked.noise)
    verdict = verdict_on(checked.candidates)
    if verdict.kind is VerdictKind.EXPLAINED:
        verdict = replace(verdict, effects=strongest_first(problem, verdict.best))
    return Judged(
        problem=problem,
        coarse=found.coarse.renoised(checked.noise, before=before),
        verdict=verdict,
        record=(*found.record, *judged(checked.candidates)),
    )
