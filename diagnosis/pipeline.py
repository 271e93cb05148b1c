"""From a log to a diagnosis, stage by stage:

RigLog -> PreparedLog -> FitProblem, fine and coarse -> SearchState -> Verdict -> Assessment -> Diagnosis

and, if nothing explains the log, Missing beside the Assessment.
"""

import time
from collections.abc import Callable
from dataclasses import dataclass, replace
from datetime import date

import numpy as np
from numpy.typing import NDArray

from diagnosis.assessment.assess import assess
from diagnosis.assessment.assessment import Assessment
from diagnosis.assessment.identifiability import testable_effects
from diagnosis.assessment.uncertainty.absent_effects import without_absent
from diagnosis.assessment.uncertainty.hidden_effects import with_hidden_effects
from diagnosis.criteria.selection import REPLAYS_AFTER_STOP
from diagnosis.fitting.decimation import decimated_noise
from diagnosis.fitting.noise_reestimation import rescaled
from diagnosis.fitting.problem import FitProblem
from diagnosis.freeform.other_form import STAGE as OTHER_FORMS
from diagnosis.freeform.other_form import other_form
from diagnosis.freeform.unknown import Told, with_what_is_missing
from diagnosis.log.faults.left_out import without
from diagnosis.log.rig_log import RigLog
from diagnosis.nominal_replay import NominalReplay, at_samples, replay_nominal
from diagnosis.progress import ProgressClock, Watcher, silent
from diagnosis.result import Diagnosis
from diagnosis.selection.candidate import candidate
from diagnosis.selection.contributions import strongest_first
from diagnosis.selection.equivalence.told_apart import ToldApart, told_apart
from diagnosis.selection.record import Decision, RecordEntry, dropped, judged, noted, refused
from diagnosis.selection.search_of_log import search_log
from diagnosis.selection.state import SearchState
from diagnosis.selection.verdicts.about_as_near import with_what_is_as_near
from diagnosis.selection.verdicts.changed import provisional, refuted
from diagnosis.selection.verdicts.plainly_named import plainly_named
from diagnosis.selection.verdicts.verdict import Verdict, VerdictKind
from diagnosis.stages import ASSESSING, CHECKING, REPLAYING, in_words
from diagnosis.stopping import EarlyStop, StoppedEarly, StopSignal, listening
from diagnosis.workers import Workers, process_pool
from sim.simulation import prepare_processes

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True, eq=False)
class Judged:
    """A verdict, with the problems that it is based on.

    Attributes:
      problem, coarse: with the noise from the residual of the best explanation.
      record: record of the search and of the verdict.
      cut: whether the search was stopped.
    """

    problem: FitProblem
    coarse: FitProblem
    verdict: Verdict
    record: tuple[RecordEntry, ...]
    cut: bool = False


def diagnose(
    log: RigLog,
    *,
    workers: int = 2,
    limit_s: float | None = None,
    stop: StopSignal | None = None,
    progress: Watcher = silent,
    diagnosed_on: date | None = None,
    meanwhile: Callable[[], object] | None = None,
) -> Diagnosis:
    """Diagnose a log, to the end or as far as there is time.

    Args:
      workers: number of processes.
      limit_s: time after which the best result so far is reported, s; None: no limit.
      stop: a signal with its own limit, which may be given at any time.
      progress: called at every stage and task, and ten times per second in between.
      diagnosed_on: date for the report; None: none.
      meanwhile: called in a thread while other processes compute; its errors are ignored.

    Raises:
      SimulationFailed: the nominal rig cannot be simulated.
      StoppedEarly: it was stopped before the nominal rig was replayed.
    """
    stop = StopSignal(limit_s) if stop is None else stop
    heard = ProgressClock(progress, stop).heard
    heard(REPLAYING, 0, 1)
    prepare_processes()
    nominal = _nominal_in_time(log, stop)
    heard(REPLAYING, 1, 1)
    with process_pool(workers, heard, stop, meanwhile=meanwhile) as pool, listening(stop):
        nominal, found = search_log(log, nominal, testable_effects(log), pool)
        nominal = nominal.begun_as(found.problem, found.nominal)
        log = without(nominal.log, found.left_out)
        last, assessment = _concluded(log, nominal, found, pool)
        more = with_hidden_effects(
            found, last.verdict.best.fit, assessment.detection_limits, assessment.parameters, pool
        )
        if more.best not in found.candidates:
            last, assessment = _concluded(log, nominal, more, pool)
        known = Told(problem=last.problem, verdict=last.verdict, assessment=assessment)
        told = with_what_is_missing(log, known, last.coarse, nominal.predictions, found.effects, pool)
    return Diagnosis(
        log=log,
        noise=told.problem.noise,
        nominal=at_samples(told.problem, nominal.predictions),
        verdict=told.verdict,
        assessment=told.assessment,
        missing=told.missing,
        record=last.record,
        stopped=_early_stop(stop, last.cut),
        diagnosed_on=diagnosed_on,
    )


def _nominal_in_time(log: RigLog, stop: StopSignal) -> NominalReplay:
    """The nominal replay; its duration tells the time that the last stage needs."""
    began_s = time.monotonic()
    nominal = replay_nominal(log)
    if stop.over:
        raise StoppedEarly(
            f"{stop.why}: stopped before the nominal rig was replayed; there is no result yet"
        )
    stop.reserve(REPLAYS_AFTER_STOP * (time.monotonic() - began_s))
    return nominal


def _concluded(
    log: RigLog, nominal: NominalReplay, found: SearchState, workers: Workers
) -> tuple[Judged, Assessment]:
    """The verdict on what a search has found, and its assessment."""
    told, heard = told_apart(found, workers), workers.progress
    cut = bool(workers.stop.left_out)
    heard(CHECKING, 0, 1)
    last = _of_another_form(_judged(told, cut=cut), nominal, workers)
    verdict = with_what_is_as_near(last.verdict, told.state)
    last = replace(last, verdict=plainly_named(verdict, last.problem))
    heard(CHECKING, 1, 1)
    heard(ASSESSING, 0, 1)
    assessment = _assessed(log, nominal, last, found, workers)
    if last.verdict.effects and (why_not := assessment.gap.refutes):
        last = _refuted(last, why_not)
        assessment = _assessed(log, nominal, last, found, workers)
    last, assessment = _without_absent(last, assessment)
    heard(ASSESSING, 1, 1)
    return last, assessment


def _assessed(
    log: RigLog, nominal: NominalReplay, judged: Judged, found: SearchState, workers: Workers
) -> Assessment:
    problem, coarse, verdict = judged.problem, judged.coarse, judged.verdict
    return assess(log, problem, coarse, nominal.predictions, verdict, found.effects, workers)


def _early_stop(stop: StopSignal, search: bool) -> EarlyStop | None:
    if not stop.left_out:
        return None
    stage, left_out = in_words(stop.left_out[0]), tuple(stop.left_out)
    return EarlyStop(why=stop.why, stage=stage, left_out=left_out, search=search)


def _of_another_form(judged: Judged, nominal: NominalReplay, workers: Workers) -> Judged:
    """Refuted, where a law that no library holds does better than an explanation."""
    verdict = judged.verdict
    if verdict.kind not in (VerdictKind.EXPLAINED, VerdictKind.UNDECIDED):
        return judged
    best = verdict.best.fit
    form = workers.stop.unless_due(OTHER_FORMS, lambda: other_form(nominal, best, workers))
    return judged if form is None else _refuted(judged, form.in_words)


def _refuted(judged: Judged, why_not: str) -> Judged:
    """The same, unknown: the explanation is none, for the reason given."""
    entry = dropped("verdict", [judged.verdict.best], why_not)
    plain = _without_drift(judged)
    return replace(plain, verdict=refuted(plain.verdict, why_not), record=(*judged.record, *entry))


def _without_drift(judged: Judged) -> Judged:
    """The same with sensors that do not drift, which would hide a part of what is missing."""
    fine, coarse = judged.problem, judged.coarse
    noise = replace(fine.noise, drifts={})
    best = candidate(rescaled(judged.verdict.best.fit, fine, noise))
    return replace(
        judged,
        problem=replace(fine, noise=noise),
        coarse=replace(coarse, noise=decimated_noise(noise, fine.log, coarse.log)),
        verdict=replace(judged.verdict, best=best),
    )


def _without_absent(judged: Judged, assessment: Assessment) -> tuple[Judged, Assessment]:
    """Both without effects that may as well be absent."""
    sample_s = min(trial.sample_s for trial in judged.problem.log.trials)
    verdict = without_absent(judged.verdict, assessment.parameters, sample_s, refused(judged.record))
    if verdict is judged.verdict:
        return judged, assessment
    parameters = {name: own for name, own in assessment.parameters.items() if name in verdict.effects}
    absent = [name for name in judged.verdict.effects if name not in verdict.effects]
    entry = noted("verdict", Decision.DROPPED, f"{', '.join(absent)}: the interval reaches its absence")
    return (
        replace(judged, verdict=verdict, record=(*judged.record, entry)),
        replace(assessment, parameters=parameters),
    )


def _judged(told: ToldApart, *, cut: bool) -> Judged:
    """The verdict on the result of the search; provisional if that was stopped."""
    found, checked, verdict = told.state, told.checked, told.verdict
    problem = replace(found.problem, noise=checked.noise)
    if verdict.kind is VerdictKind.EXPLAINED:
        verdict = replace(verdict, effects=strongest_first(problem, verdict.best))
    if cut:
        verdict = provisional(verdict, told.candidates)
    return Judged(
        problem=problem,
        coarse=told.coarse,
        verdict=verdict,
        record=(*found.record, *judged(told.candidates)),
        cut=cut,
    )
