"""Fitting many sets of effects, with a record of what was made, dropped or failed."""

from collections.abc import Iterable, Sequence
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from diagnosis.criteria.selection import (
    EQUAL_SCORE,
    FINALISTS,
    MOST_FINALISTS,
    NEAR_FLOOR,
    SIMPLE_LEAD,
    SLOPES_OF_ITS_OWN,
)
from diagnosis.fitting.fit import Fit, fit_effects
from diagnosis.fitting.fit_status import Termination
from diagnosis.fitting.problem import FitProblem
from diagnosis.selection.candidate import Candidate, candidate
from diagnosis.selection.record import RecordEntry, dropped, failed, made
from diagnosis.selection.scoring.unresolved import contending
from diagnosis.stopping import NEVER, listening
from diagnosis.workers import Failure, Task, Workers, attempt

Array = NDArray[np.float64]
Made = tuple[list[Candidate], tuple[RecordEntry, ...]]
"""Candidates, and the record of how they came about."""


_LEADING_SIGMA = 0.1  # tolerance of a fit that leads to where one with slopes of its own begins
_FINER_ITERATIONS = 2  # with known slopes


def fit_all(stage: str, calls: Sequence[tuple[Any, ...]], workers: Workers) -> Made:
    """Candidates of calls of `fit_in_turn` (problem, names, start, enough), in their order."""
    tasks = [Task(effects=tuple(call[1]), arguments=call) for call in calls]
    return candidates_of(stage, workers.each(stage, fit_in_turn, tasks))


def fit_in_turn(
    problem: FitProblem, names: Sequence[str], start: Array | None = None, enough: float = np.inf
) -> Fit:
    """Fit with slopes from runs half as fine, a quarter of the cost; then, where that comes near the
    noise, from there with slopes of its own. On the decimated log all fits have rough slopes.

    Raises:
      SimulationFailed: as `fit_effects`.
    """
    if problem.callback_alone:
        return fit_effects(problem, names, start, enough)
    first = _leading(problem, names, start, enough)
    if first.gap > SLOPES_OF_ITS_OWN or first.status.termination is Termination.BEHIND:
        return first
    return fit_effects(problem, names, first.x, enough, from_a_fit=True)


def _leading(problem: FitProblem, names: Sequence[str], start: Array | None, enough: float) -> Fit:
    """A fit with slopes of coarser runs; on a finer mesh than usual, from mesh to mesh."""
    usual = problem.resolution.nearer_the_usual
    if usual == problem.resolution:
        rough = replace(problem, differences_halved=True, tolerance_sigma=_LEADING_SIGMA)
        return fit_effects(rough, names, start, enough)
    coarser = _leading(replace(problem, resolution=usual), names, start, enough)
    finer = on_a_finer_mesh(problem, coarser)
    return replace(finer, status=coarser.status) if coarser.status.ended_early else finer


def on_a_finer_mesh(problem: FitProblem, coarser: Fit) -> Fit:
    """A fit, taken on to a problem of a finer mesh, which hardly changes its slopes.

    Raises:
      SimulationFailed: as `fit_effects`.
    """
    slopes, most = coarser.slopes, _FINER_ITERATIONS
    return fit_effects(problem, coarser.names, coarser.x, slopes=slopes, most_iterations=most)


def candidates_of(stage: str, results: Sequence[Fit | Failure]) -> Made:
    """Candidates of fits, in their order; failures are in the record."""
    found = [candidate(fit) for fit in results if not isinstance(fit, Failure)]
    failures = [fit for fit in results if isinstance(fit, Failure)]
    return found, (*made(stage, found), *failed(stage, failures))


def fit_finalists(
    stage: str, problem: FitProblem, contenders: Sequence[Candidate], workers: Workers
) -> Made:
    """The best contenders, fitted on the log itself; given up where they stay far above the noise.

    Args:
      contenders: on the decimated log, best first.
    """
    near = in_question(problem, contenders)
    most = min(max(FINALISTS, len(_within(SIMPLE_LEAD, contenders))), MOST_FINALISTS)
    finalists = first_of(near, most)[:MOST_FINALISTS]
    beyond = near[len(finalists) :]
    far = [c for c in contenders if c not in near]
    enough = NEAR_FLOOR * problem.samples
    found, record = fit_all(stage, [(problem, c.names, c.fit.x, enough) for c in finalists], workers)
    if finalists and not found and workers.stop.due:
        found, record = _in_short(stage, problem, finalists[0], record)
    lost = (
        *dropped(stage, beyond, f"{most} others are better on the decimated log"),
        *dropped(
            stage, far, f"behind the best on the decimated log by more than {contending(problem):.3g}"
        ),
    )
    return found, (*record, *lost)


def fit_beside(
    stage: str, problem: FitProblem, one: Candidate, sets: Iterable[tuple[str, ...]], workers: Workers
) -> Made:
    """Other sets of effects from where a candidate is; given up where they stay far behind it."""
    starts = [(names, problem.parameterization(names).joined(one.fit.parts)) for names in sets]
    enough = one.score + contending(problem)
    return fit_all(stage, [(problem, names, start, enough) for names, start in starts], workers)


def _in_short(
    stage: str, problem: FitProblem, first: Candidate, record: tuple[RecordEntry, ...]
) -> Made:
    """The best contender after one step on the log itself, where there was no time for more."""
    step = partial(fit_effects, most_iterations=1)
    with listening(NEVER):
        fit = attempt(step, Task(effects=first.names, arguments=(problem, first.names, first.fit.x)))
    if isinstance(fit, Failure):
        return [], (*record, *failed(stage, [fit]))
    found = [candidate(fit)]
    return found, (*record, *made(stage, found))


def in_question(problem: FitProblem, ranked: Sequence[Candidate]) -> list[Candidate]:
    """Candidates that a finer replay may put first, best first.

    That is those that are not out of the question; and if they are few, others at the noise floor: on
    the decimated log replays err by up to half a sigma.
    """
    near = _within(contending(problem), ranked)
    at_floor = [c for c in ranked if c.floor.reached and c not in near]
    return near + at_floor[: max(FINALISTS - len(near), 0)]


def first_of(ranked: Sequence[Candidate], most: int) -> list[Candidate]:
    """The first so many, and those next that tie with the last of them: which is out would be chance."""
    first = list(ranked[:most])
    for one in ranked[most:]:
        if abs(one.score - first[-1].score) > EQUAL_SCORE:
            break
        first.append(one)
    return first


def _within(lead: float, ranked: Sequence[Candidate]) -> list[Candidate]:
    """Those that are behind the first by no more than that."""
    return [c for c in ranked if c.score - ranked[0].score <= lead]
