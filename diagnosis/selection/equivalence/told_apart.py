"""A verdict that knows what else would have changed the readings in the same way.

Equivalent sets of as many effects as the chosen one, or of fewer, become candidates, as do fewer effects
that are nearly alike: scores decide as among all others. So do these without stiffness and damping, as
these scatter by a few per cent from rig to rig: beside a gain of the torque by 1.012, a stiffness of
1.0005 is none. Larger ones are named beside it: one cause is likelier than several that happen to be
equal, and no log can tell. Imperfections of sensors, which have no name in a verdict, may take the place
of effects in candidates: a low-pass filter of the torque is nearly a delay.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from diagnosis.criteria.fitting import SCATTER
from diagnosis.criteria.selection import CONTENDING, SIMPLE_LEAD
from diagnosis.effects import IMPERFECTIONS, LIBRARY
from diagnosis.fitting.decimation import decimated_noise
from diagnosis.fitting.fit import Fit, fit_effects
from diagnosis.fitting.parameterization import Parameterization
from diagnosis.fitting.problem import FitProblem
from diagnosis.selection.candidate import Candidate
from diagnosis.selection.checked import Checked, check
from diagnosis.selection.equivalence.equivalent_sets import (
    Equivalent,
    covers,
    equivalent_sets,
)
from diagnosis.selection.equivalence.noiseless_log import Parts
from diagnosis.selection.equivalence.weak_forms import WeakForm, weak_forms, with_their_scores
from diagnosis.selection.fitting import candidates_of, fit_in_turn
from diagnosis.selection.scoring.replay_errors import without_replay_errors
from diagnosis.selection.state import SearchState
from diagnosis.selection.verdicts.changed import with_open_effects
from diagnosis.selection.verdicts.decision import verdict_on
from diagnosis.selection.verdicts.verdict import Verdict, VerdictKind, distinct
from diagnosis.workers import Failure, Task, Workers
from sim.needles.run import SimulationFailed

Array = NDArray[np.float64]

_STAGE = "what cannot be told apart"
_ROUNDS = 2  # an equivalent set that takes the lead has equivalents of its own


@dataclass(frozen=True, kw_only=True, eq=False)
class ToldApart:
    """A verdict, with what cannot be told from it.

    Attributes:
      state: of the search, with the equivalent sets that were fitted.
      checked: its candidates.
      candidates: what the verdict is on, best first.
      forms: richer laws that may be there without showing their shape.
    """

    state: SearchState
    checked: Checked
    candidates: Sequence[Candidate]
    verdict: Verdict
    forms: Sequence[WeakForm] = ()

    @property
    def problem(self) -> FitProblem:
        """The log, with the noise that the best explanation leaves."""
        return replace(self.state.problem, noise=self.checked.noise)

    @property
    def coarse(self) -> FitProblem:
        """The decimated log, with the noise that the best explanation leaves."""
        coarse = self.state.coarse
        noise = decimated_noise(self.checked.noise, self.state.problem.log, coarse.log)
        return replace(coarse, noise=noise)


def told_apart(found: SearchState, workers: Workers) -> ToldApart:
    """The verdict on what a search found, with what cannot be told from it."""
    told = _told_apart(found, workers)
    return replace(told, verdict=with_open_effects(told.verdict, found.open_effects))


def _told_apart(found: SearchState, workers: Workers) -> ToldApart:
    first = _judged(found)
    if not first.verdict.effects:
        return first
    if workers.stop.due:
        workers.stop.leave_out(_STAGE)
        return first
    wider, forms = _with_weak_forms(found, first, workers)
    if forms:
        first = _judged(wider, first.checked, forms)
    told, alike = first, list[tuple[str, ...]]()
    for _ in range(_ROUNDS):
        before = told.verdict
        told, equal = _with_equals(told, workers)
        alike += [before.effects, *(names for names in equal if set(names) <= set(LIBRARY))]
        if set(told.verdict.effects) == set(before.effects):
            break
    return replace(told, verdict=_beside(told.verdict, alike))


def _with_equals(told: ToldApart, workers: Workers) -> tuple[ToldApart, list[tuple[str, ...]]]:
    """The verdict with equivalent sets of no more effects as candidates, and all equivalent sets."""
    verdict = told.verdict
    open_ = set(verdict.best.names) & set(IMPERFECTIONS)
    effects = [name for name in told.state.effects if name not in open_]
    equal = equivalent_sets(told.coarse, verdict.best, effects, workers) if verdict.effects else ()
    few = [e for e in equal if len(e.names) <= len(verdict.effects)]
    few += _without_scatter(few)
    wider = _fitted(told.state, verdict.best, few, workers)
    last = told if wider is told.state else _judged(wider, told.checked, told.forms)
    return last, [e.names for e in equal if not e.told_apart]


def _without_scatter(equal: Sequence[Equivalent]) -> list[Equivalent]:
    """Sets with stiffness or damping, left to their scatter, each once."""
    left = [(e, tuple(name for name in e.names if name not in SCATTER)) for e in equal]
    fewer = {frozenset(names): (e, names) for e, names in left if 0 < len(names) < len(e.names)}
    return [replace(e, names=names, parts={n: e.parts[n] for n in names}) for e, names in fewer.values()]


def _judged(
    found: SearchState, known: Checked | None = None, forms: Sequence[WeakForm] = ()
) -> ToldApart:
    checked = check(found.problem, found.candidates, known or found.checked)
    scored = without_replay_errors(replace(found.problem, noise=checked.noise), checked.candidates)
    scored = with_their_scores(scored, forms)
    verdict = verdict_on(scored)
    return ToldApart(state=found, checked=checked, candidates=scored, verdict=verdict, forms=forms)


def _with_weak_forms(
    found: SearchState, first: ToldApart, workers: Workers
) -> tuple[SearchState, Sequence[WeakForm]]:
    """The state with richer laws that may be there without showing their shape, and their scores."""
    verdict = first.verdict
    tasks = [
        Task(effects=one.names, arguments=(first.problem, one))
        for one in (verdict.best, *verdict.rivals)
        if one.explains
    ]
    results = workers.each(_STAGE, weak_forms, tasks)
    forms = [form for own in results if not isinstance(own, Failure) for form in own]
    known = {frozenset(c.names) for c in found.candidates}
    near = [f for f in forms if f.score - verdict.best.score <= SIMPLE_LEAD and {*f.names} not in known]
    tasks = [Task(effects=f.names, arguments=(found.problem, f.names, f.start)) for f in near]
    return found.adding(candidates_of(_STAGE, workers.each(_STAGE, _one_step, tasks))), forms


def _one_step(problem: FitProblem, names: tuple[str, ...], start: Array) -> Fit:
    return fit_effects(problem, names, start, most_iterations=1, from_a_fit=True)


def _fitted(
    found: SearchState, best: Candidate, equal: Sequence[Equivalent], workers: Workers
) -> SearchState:
    """The state with equivalent sets fitted to the log itself; the same if all of them are known."""
    near = best.score + CONTENDING  # others may have been fitted from where they could not come nearer
    known = {frozenset(c.names) for c in found.candidates if c.score <= near}
    sensors = tuple(name for name in best.names if name in IMPERFECTIONS)
    sets = [((*e.names, *sensors), e.parts) for e in equal]
    calls = [
        (found.problem, names, parts, best.fit.parts)
        for names, parts in sets
        if frozenset(names) not in known
    ]
    tasks = [Task(effects=call[1], arguments=call) for call in calls]
    return found.adding(candidates_of(_STAGE, workers.each(_STAGE, _fit, tasks))) if tasks else found


def _fit(problem: FitProblem, names: tuple[str, ...], alike: Parts, best: Parts) -> Fit:
    """The fit of an equivalent set: what it shares with the best begins as there, or as is alike.

    What is open besides, as the past of a trial, is that of the best.

    Raises:
      SimulationFailed: as `fit_effects`.
    """
    own = problem.parameterization(names)
    starts = [own.joined(parts) for parts in (best | alike, alike | best)]
    return fit_in_turn(problem, names, min(starts, key=lambda x: _left(problem, own, x)))


def _left(problem: FitProblem, own: Parameterization, x: Array) -> float:
    """Sum of squares of the residuals there; infinite, if that cannot be simulated."""
    try:
        runs = problem.residuals([own.rig(x)], callback_alone=True)
    except SimulationFailed:
        return np.inf
    return sum(float(run @ run) for (run,) in runs)


def _beside(verdict: Verdict, alike: Sequence[tuple[str, ...]]) -> Verdict:
    """The verdict with all sets that are alike; richer forms of a set that is told add nothing."""
    if verdict.kind is VerdictKind.UNKNOWN:
        return verdict
    told = list(distinct(verdict.confusable or (verdict.effects,)))
    most = max(len(names) for names in told)
    for names in sorted(alike, key=len):
        beyond = verdict.kind is VerdictKind.UNDECIDED and len(names) > most
        if not beyond and not any(known and covers(names, known) for known in told):
            told.append(names)
    return replace(verdict, confusable=tuple(told) if len(told) > 1 else ())
