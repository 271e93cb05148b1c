"""Fits of what screening promises, as long as they can come near the best."""

from collections import Counter
from collections.abc import Iterable, Sequence

import numpy as np

from diagnosis.criteria.fitting import GAP_LIMIT
from diagnosis.criteria.selection import FITS_AT_ONCE, NEAR_FLOOR, PREDICTION_MISSED
from diagnosis.effects import FITTED
from diagnosis.fitting.fit import Fit
from diagnosis.fitting.problem import FitProblem
from diagnosis.selection.candidate import Candidate
from diagnosis.selection.fitting import Made, candidates_of, fit_all, fit_in_turn
from diagnosis.selection.record import RecordEntry, dropped, not_fitted
from diagnosis.selection.scoring.complexity import choice_penalty
from diagnosis.selection.scoring.unresolved import contending
from diagnosis.selection.screening import Screened, neutral_start
from diagnosis.workers import Task, Workers

_TOO_FAR = "expected to stay far above what is at the noise floor"
_NO_BETTER = "another start of the same effects left no more than this one promises"


def fit_screened(
    stage: str,
    problem: FitProblem,
    screened: Sequence[Screened],
    most: int,
    workers: Workers,
    *,
    used: int = 1,
) -> Made:
    """Fits of the most promising sets, the best of each set, best first.

    Once something brings the residual to the noise floor, only what promises to come near it
    is still fitted, what that contains, and other starts of what came there at a bound of its range.
    A fit that cannot come near enough to be of use is given up.
    Further starts of a set come after the first of each, and not at all where they promise to leave no
    less than that has. Where a fit leaves far more than was promised, or has wound up a trial's past as
    far as it goes, it begins once more elsewhere.

    Args:
      used: how many sets are of use, where none comes to the noise floor.
    """
    waiting = _first_starts_first(sorted(screened, key=lambda s: s.cost)[:most])
    found, record = list[Candidate](), list[RecordEntry]()
    far, no_better = list[Screened](), list[Screened]()
    again = set[frozenset[str]]()
    while waiting:
        batch, waiting = waiting[:FITS_AT_ONCE], waiting[FITS_AT_ONCE:]
        calls = [(problem, s.names, s.start, _enough(problem, s.names, found, used)) for s in batch]
        new, entries = fit_all(stage, calls, workers)
        broken = [s for s in batch if _is_broken(s, new) and frozenset(s.names) not in again]
        again |= {frozenset(s.names) for s in broken}
        others, more = _fit_neutrally(stage, problem, broken, [*found, *new], used, workers)
        found += [*new, *others]
        record += [*entries, *more]
        at_floor = [c for c in found if c.floor.small]
        floor = min((c.fit.cost for c in at_floor), default=np.inf)
        inner = {i for c in at_floor for n in c.names for i in FITTED[n].contains}
        at_bound = {frozenset(c.names) for c in at_floor if c.fit.status.at_bound}
        far += [s for s in waiting if not (_still(s, floor, inner) or frozenset(s.names) in at_bound)]
        no_better += [s for s in waiting if s not in far and _found(s, found)]
        waiting = [s for s in waiting if s not in far and s not in no_better]
    record += not_fitted(stage, _sets(far), _TOO_FAR)
    record += not_fitted(stage, _sets(no_better), _NO_BETTER)
    best = _best_of_each_set(found)
    out = [c for c in found if c not in best]
    return best, (*record, *dropped(stage, out, "another start of the same effects fits better"))


def _fit_neutrally(
    stage: str,
    problem: FitProblem,
    broken: Sequence[Screened],
    found: Sequence[Candidate],
    used: int,
    workers: Workers,
) -> Made:
    """Fits of sets once more, from where nothing was taken over."""
    calls = [(problem, s, _enough(problem, s.names, found, used)) for s in broken]
    tasks = [Task(effects=call[1].names, arguments=call) for call in calls]
    return candidates_of(stage, workers.each(stage, _fit_from_neutral, tasks)) if tasks else ([], ())


def _fit_from_neutral(problem: FitProblem, one: Screened, enough: float) -> Fit:
    return fit_in_turn(problem, one.names, neutral_start(problem, one), enough)


def _is_broken(one: Screened, new: Sequence[Candidate]) -> bool:
    """Whether every fit of a set leaves far more than was promised, or a past at its bound."""
    own = [c.fit for c in new if c.names == one.names]
    return bool(own) and all(f.trial_at_bound or f.cost > PREDICTION_MISSED * one.cost for f in own)


def _enough(problem: FitProblem, names: tuple[str, ...], found: Sequence[Candidate], used: int) -> float:
    """Cost that a fit of these effects has to come below to be of use beside what was found."""
    best = _best_of_each_set(found)
    at_floor = any(c.floor.small for c in best)
    if not best or (len(best) < used and not at_floor):
        return np.inf
    last = best[0] if at_floor else best[used - 1]
    score = max(best[0].score + contending(problem), last.score)
    return score - choice_penalty(names)


def _still(one: Screened, floor: float, inner: set[str]) -> bool:
    return one.cost <= NEAR_FLOOR * floor or not inner.isdisjoint(one.names)


def _found(one: Screened, found: Sequence[Candidate]) -> bool:
    """Whether its set was fitted, within its range, and leaves no more than this start promises.

    The set that leaves least is not, unless it leaves noise, no more and no less: it may have ended in
    another minimum, and where that leaves less, the noise is less than it was taken to be.
    """
    own = [c for c in found if {*c.names} == {*one.names}]
    least = min(found, key=lambda c: c.fit.cost, default=None)
    if least in own and not (least.floor.reached and least.floor.gap >= 1.0 / GAP_LIMIT):
        return False
    return any(c.fit.cost <= one.cost for c in own if not c.fit.status.at_bound)


def _first_starts_first(ranked: Sequence[Screened]) -> list[Screened]:
    """The first start of each set, then the second ones, and so on."""
    seen = Counter[frozenset[str]]()
    turns = list[int]()
    for one in ranked:
        turns.append(seen[frozenset(one.names)])
        seen[frozenset(one.names)] += 1
    return [one for _, one in sorted(zip(turns, ranked, strict=True), key=lambda pair: pair[0])]


def _sets(screened: Iterable[Screened]) -> Iterable[tuple[str, ...]]:
    return dict.fromkeys(s.names for s in screened)


def _best_of_each_set(found: Sequence[Candidate]) -> list[Candidate]:
    best: dict[frozenset[str], Candidate] = {}
    for c in sorted(found, key=lambda c: c.score):
        best.setdefault(frozenset(c.names), c)
    return list(best.values())
