"""A verdict that knows what else would have changed the readings in the same way.

Equivalent sets of as many effects as the chosen one, or of fewer, become candidates: scores decide as
among all others. Larger ones are named beside it: one cause is likelier than several that happen to
be equal, and no log can tell. Imperfections of sensors, which have no name in a verdict, may take the
place of effects in candidates: a low-pass filter of the torque is nearly a delay.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

from diagnosis.effects import IMPERFECTIONS, LIBRARY
from diagnosis.fitting.decimation import decimated_noise
from diagnosis.fitting.problem import FitProblem
from diagnosis.selection.candidate import Candidate
from diagnosis.selection.checked import Checked, check
from diagnosis.selection.equivalence.equivalent_sets import Equivalent, covers, equivalent_sets
from diagnosis.selection.fitting import fit_all
from diagnosis.selection.state import SearchState
from diagnosis.selection.verdict import Verdict, VerdictKind, verdict_on
from diagnosis.workers import Workers

_STAGE = "what cannot be told apart"


@dataclass(frozen=True, kw_only=True, eq=False)
class ToldApart:
    """A verdict, with what cannot be told from it.

    Attributes:
      state: of the search, with the equivalent sets that were fitted.
      checked: its candidates.
    """

    state: SearchState
    checked: Checked
    verdict: Verdict

    @property
    def coarse(self) -> FitProblem:
        """The decimated log, with the noise that the best explanation leaves."""
        coarse = self.state.coarse
        noise = decimated_noise(self.checked.noise, self.state.problem.log, coarse.log)
        return replace(coarse, noise=noise)


def told_apart(found: SearchState, workers: Workers) -> ToldApart:
    """The verdict on what a search found, with what cannot be told from it."""
    first = _judged(found)
    if not first.verdict.effects:
        return first
    if workers.stop.due:
        workers.stop.leave_out(_STAGE)
        return first
    open_ = set(first.verdict.best.names) & set(IMPERFECTIONS)
    effects = [name for name in found.effects if name not in open_]
    equal = equivalent_sets(first.coarse, first.verdict.best, effects, workers)
    few = [e for e in equal if len(e.names) <= len(first.verdict.effects)]
    wider = _fitted(found, first.verdict.best, few, workers)
    last = first if wider is found else _judged(wider, first.checked)
    named = (e.names for e in equal if set(e.names) <= set(LIBRARY))
    alike = [first.verdict.effects, *named]
    return replace(last, verdict=_beside(last.verdict, alike))


def _judged(found: SearchState, known: Checked | None = None) -> ToldApart:
    checked = check(found.problem, found.candidates, known or found.checked)
    return ToldApart(state=found, checked=checked, verdict=verdict_on(checked.candidates))


def _fitted(
    found: SearchState, best: Candidate, equal: Sequence[Equivalent], workers: Workers
) -> SearchState:
    """The state with equivalent sets fitted to the log itself; the same if all of them are known."""
    known = {frozenset(c.names) for c in found.candidates}
    sensors = tuple(name for name in best.names if name in IMPERFECTIONS)
    sets = [((*e.names, *sensors), e.parts) for e in equal]
    calls = [
        (found.problem, names, found.problem.parameterization(names).joined(parts))
        for names, parts in sets
        if frozenset(names) not in known
    ]
    return found.adding(fit_all(_STAGE, calls, workers)) if calls else found


def _beside(verdict: Verdict, alike: Sequence[tuple[str, ...]]) -> Verdict:
    """The verdict with all sets that are alike; richer forms of a set that is told add nothing."""
    told = list({frozenset(names): names for names in verdict.confusable or (verdict.effects,)}.values())
    most = max(len(names) for names in told)
    for names in sorted(alike, key=len):
        beyond = verdict.kind is VerdictKind.UNDECIDED and len(names) > most
        if not beyond and not any(covers(names, known) for known in told):
            told.append(names)
    return replace(verdict, confusable=tuple(told) if len(told) > 1 else ())
