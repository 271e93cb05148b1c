"""A replay as fine as the log asks.

The usual needle is good to a few hundredths of the noise. It is not where elastic
tissue is met by a needle that moves, element by element, or where noise is very small.
So the best explanation is replayed with twice the elements, and with half the step: where
that changes a trial by more than a tenth of the noise, and by no small part of what is
left there beyond noise, the leading explanations are fitted again so finely.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from diagnosis.criteria.replay import FINEST_ELEMENTS, FINEST_STEP_S, REFINE_SHARE, REFINE_SIGMA
from diagnosis.criteria.selection import NEAR_FLOOR
from diagnosis.fitting.fit import Fit
from diagnosis.fitting.problem import FitProblem
from diagnosis.replay.resolution import Resolution
from diagnosis.selection.candidate import Candidate
from diagnosis.selection.fitting import candidates_of, in_question, on_a_finer_mesh
from diagnosis.selection.record import RecordEntry, dropped
from diagnosis.selection.scoring.unresolved import contending
from diagnosis.selection.stages.stage import stopped_in
from diagnosis.selection.state import SearchState
from diagnosis.workers import Task, Workers
from sim.needles.run import SimulationFailed

Array = NDArray[np.float64]

STAGE = "mesh refinement"


def finer_mesh_near_the_floor(state: SearchState, workers: Workers) -> SearchState:
    """A finer mesh where that may be all that is missing: it makes what follows many times dearer."""
    near = state.best.fit.gap**2 <= NEAR_FLOOR
    return finer_mesh(state, workers) if near else state


def finer_mesh(state: SearchState, workers: Workers) -> SearchState:
    """A replay as fine as the log asks, and candidates fitted to it."""
    problem, found, record = refined_mesh(state.problem, state.candidates, workers)
    if stopped := stopped_in(record):
        return state.noting(*stopped)  # costs at two resolutions do not compare
    return replace(state, problem=problem, candidates=tuple(found)).noting(*record)


def refined_mesh(
    problem: FitProblem, candidates: Sequence[Candidate], workers: Workers
) -> tuple[FitProblem, list[Candidate], tuple[RecordEntry, ...]]:
    """A problem whose replay is fine enough, candidates fitted to it, best first, and the record.

    Args:
      candidates: fitted to the problem; they come back as they are if it is fine enough.
    """
    found, record = sorted(candidates, key=lambda c: c.score), list[RecordEntry]()
    while (finer := _finer(problem, found[0].fit)) != problem.resolution:
        finer_problem = replace(problem, resolution=finer)
        again, entries = _fitted_again(finer_problem, found, workers)
        record += entries
        if not again:
            break
        problem, found = finer_problem, sorted(again, key=lambda c: c.score)
    return problem, found, tuple(record)


def _finer(problem: FitProblem, best: Fit) -> Resolution:
    """The resolution with more elements and shorter steps, as far as they would change a trial."""
    there = problem.resolution
    more = replace(there, elements=min(2 * there.elements, FINEST_ELEMENTS))
    shorter = replace(there, step_s=max(there.step_s / 2, FINEST_STEP_S))
    return Resolution(
        elements=more.elements if _matters(problem, best, more) else there.elements,
        step_s=shorter.step_s if _matters(problem, best, shorter) else there.step_s,
    )


def _matters(problem: FitProblem, best: Fit, resolution: Resolution) -> bool:
    if resolution == problem.resolution:
        return False
    finer = replace(problem, resolution=resolution)
    try:
        runs = finer.residuals([best.parameterization.rig(best.x)], callback_alone=True)
    except SimulationFailed:
        return False  # what cannot be simulated so finely stays as it is
    return any(_is_much(r[0] - left, left) for r, left in zip(runs, best.by_trial, strict=True))


def _is_much(change: Array, left: Array) -> bool:
    """Whether a change of a trial's residual matters to what is left of it."""
    beyond_noise = float(left @ left) - left.size
    return float(change @ change) > max(REFINE_SIGMA**2 * left.size, REFINE_SHARE * beyond_noise)


def _fitted_again(
    problem: FitProblem, candidates: Sequence[Candidate], workers: Workers
) -> tuple[list[Candidate], tuple[RecordEntry, ...]]:
    """The leading candidates, fitted from where they are; a finer replay hardly changes their slopes."""
    near = in_question(problem, candidates)
    tasks = [
        Task(
            effects=c.names,
            arguments=(replace(problem, nuisance=c.fit.parameterization.nuisance), c.fit),
        )
        for c in near
    ]
    found, record = candidates_of(STAGE, workers.each(STAGE, on_a_finer_mesh, tasks))
    out = [c for c in candidates if c not in near]
    return found, (
        *record,
        *dropped(STAGE, out, f"behind the best by more than {contending(problem):.3g}"),
    )
