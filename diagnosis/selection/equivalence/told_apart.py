"""A verdict that knows what else would have changed the readings in the same way.

Equivalent sets of as many effects as the chosen one, or of fewer, become candidates: scores decide as
among all others. Larger ones are named beside it: one cause is likelier than several that happen to
be equal, and no log can tell.
"""

from collections.abc import Sequence
from dataclasses import replace

from diagnosis.effects import LIBRARY
from diagnosis.fitting.decimation import decimated_noise
from diagnosis.selection.checked import Checked, check
from diagnosis.selection.equivalence.equivalent_sets import covers, equivalent_sets
from diagnosis.selection.fitting import fit_all
from diagnosis.selection.record import RecordEntry
from diagnosis.selection.state import SearchState
from diagnosis.selection.verdict import Verdict, VerdictKind, verdict_on
from diagnosis.workers import Workers

_STAGE = "what cannot be told apart"

Told = tuple[Checked, Verdict, tuple[RecordEntry, ...]]
"""Candidates as they were checked, the verdict on them, and the record of what was fitted besides."""


def told_apart(found: SearchState, checked: Checked, workers: Workers) -> Told:
    """The verdict on what a search found, with what cannot be told from it."""
    verdict = verdict_on(checked.candidates)
    if verdict.effects and workers.stop.due:
        workers.stop.leave_out(_STAGE)
    if not verdict.effects or workers.stop.due:
        return checked, verdict, ()
    noise = decimated_noise(checked.noise, found.problem.log, found.coarse.log)
    effects = [name for name in found.effects if name in LIBRARY]
    equal = equivalent_sets(replace(found.coarse, noise=noise), verdict.best, effects, workers)
    known = {frozenset(c.names) for c in checked.candidates}
    few = [e for e in equal if len(e.names) <= len(verdict.effects)]
    calls = [
        (found.problem, e.names, found.problem.parameterization(e.names).joined(e.parts))
        for e in few
        if frozenset(e.names) not in known
    ]
    record: tuple[RecordEntry, ...] = ()
    alike = [verdict.effects, *(e.names for e in equal)]
    if calls:
        made, record = fit_all(_STAGE, calls, workers)
        checked = check(found.problem, (*found.candidates, *made), checked)
        verdict = verdict_on(checked.candidates)
    return checked, _beside(verdict, alike), record


def _beside(verdict: Verdict, alike: Sequence[tuple[str, ...]]) -> Verdict:
    """The verdict with all sets that are alike; richer forms of a set that is told add nothing."""
    told = list(verdict.confusable or (verdict.effects,))
    most = max(len(names) for names in told)
    for names in sorted(alike, key=len):
        beyond = verdict.kind is VerdictKind.UNDECIDED and len(names) > most
        if not beyond and not any(covers(names, known) for known in told):
            told.append(names)
    return replace(verdict, confusable=tuple(told) if len(told) > 1 else ())
