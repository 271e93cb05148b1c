"""Equivalence: which other sets of effects would have changed the readings of a log in the same way.

Some sets no log can tell apart: a torque gain of 1.1 is stiffness and damping both 1.1. They are found
from the model. The readings that the chosen explanation predicts, without noise, take the place of the
log; beside half of what was chosen (where secants are good to third order) every effect of the
library is simulated once, and small sets of these columns that add up to all that was chosen are
fitted to those readings. Stiffness and damping that it names may scatter about another set, or be the
other set's doing: both are looked at. What a late sensor changes is far from straight where friction is
sharp: what is beside it is looked at once more with all of its delay, which stays open. A set is
equivalent if the cost that it leaves could not tell it from the chosen one, and is next to nothing of
what the chosen one changed.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from diagnosis.criteria.selection import (
    EQUIVALENT_FITS,
    EQUIVALENT_LEAVES,
    EQUIVALENT_SIZE,
    SIMPLE_LEAD,
)
from diagnosis.effects import FITTED
from diagnosis.effects.effect import Effect
from diagnosis.fitting.fit import fit_effects
from diagnosis.fitting.problem import FitProblem
from diagnosis.selection.candidate import Candidate
from diagnosis.selection.equivalence.column_sets import beside, combinations_within
from diagnosis.selection.equivalence.effect_change import EffectChange, change_of
from diagnosis.selection.equivalence.noiseless_log import (
    NoiselessLog,
    Parts,
    names_scatter,
    noiseless_log,
)
from diagnosis.workers import Failure, Task, Workers

_ITERATIONS = 6


@dataclass(frozen=True, kw_only=True, eq=False)
class Equivalent:
    """A set of effects that changes the readings as the chosen one does.

    Attributes:
      parts: of the vector of its fit to what the chosen one predicts.
      cost: cost by which the two differ on this log.
      told_apart: whether this log could tell them apart; then it has fewer effects, and is nearly alike.
    """

    names: tuple[str, ...]
    parts: Parts
    cost: float
    told_apart: bool = False


def equivalent_sets(
    coarse: FitProblem, best: Candidate, effects: Sequence[str], workers: Workers
) -> tuple[Equivalent, ...]:
    """Sets of effects that no reading of this log tells from those of the best, smallest first.

    None contains another, all effects of the best, or a richer relative of each.

    Args:
      coarse: the decimated log.
      effects: that may be tried.
    """
    if not best.named:
        return ()
    found = _beside_half(coarse, best, (), effects, workers)
    if names_scatter(best):
        found = _more_of(found, _beside_half(coarse, best, (), effects, workers, scatters=False))
    late = tuple(name for name in best.named if coarse.library[name].delays_a_sensor)
    if late and set(best.named) - set(late):
        others = [name for name in effects if name not in late]
        whole = _beside_half(coarse, best, late, others, workers)
        found = _more_of(found, [replace(one, names=(*one.names, *late)) for one in whole])
    return found


def _more_of(found: tuple[Equivalent, ...], others: Iterable[Equivalent]) -> tuple[Equivalent, ...]:
    """Both, but for others that contain one that is equal, or that is the same."""
    known = [({*one.names}, one.told_apart) for one in found]
    new = (
        one
        for one in others
        if not any(own == {*one.names} or (own < {*one.names} and not apart) for own, apart in known)
    )
    return (*found, *new)


def _beside_half(
    coarse: FitProblem,
    best: Candidate,
    whole: tuple[str, ...],
    effects: Sequence[str],
    workers: Workers,
    *,
    scatters: bool = True,
) -> tuple[Equivalent, ...]:
    """Sets that are equivalent to named effects of the best but for some, which stay whole and open."""
    chosen = noiseless_log(coarse, best, whole, scatters=scatters)
    tasks = [Task(effects=(name,), arguments=(chosen, name)) for name in effects]
    results = workers.each("what cannot be told apart", change_of, tasks)
    columns = [c for c in results if not isinstance(c, Failure) and c.change.any()]
    return _fitted(chosen, _promising(chosen, columns), workers) if columns else ()


def covers(names: Sequence[str], others: Sequence[str]) -> bool:
    """Whether each of the others is among the names, or contained in one that is."""
    return set(others) <= {inner for n in names for inner in (n, *FITTED[n].contains)}


def _promising(
    chosen: NoiselessLog, columns: Sequence[EffectChange]
) -> list[tuple[tuple[str, ...], Parts]]:
    """Sets of effects, and where to start their fits: by linear algebra."""
    problem = chosen.problem
    if not columns:
        return []
    slopes, weights = chosen.slopes()
    changes = np.stack([chosen.changed, *(c.change for c in columns)], axis=1)
    target, *others = beside(slopes, weights, changes).T
    one_sided = np.array([_one_sided(problem.library[c.name]) for c in columns])
    allowed = max(SIMPLE_LEAD, EQUIVALENT_LEAVES * chosen.power)
    found = []
    for one in combinations_within(
        target, np.stack(others, axis=1), one_sided, EQUIVALENT_SIZE, allowed
    ):
        own = [columns[i] for i in one.columns]
        names = tuple(c.name for c in own)
        if not covers(names, tuple(chosen.own)):
            each = zip(own, one.amounts, strict=True)
            found.append((names, {c.name: problem.library[c.name].weakened(c.part, a) for c, a in each}))
    return found


def _one_sided(effect: Effect) -> bool:
    """Whether the strength of an effect has one sign."""
    first = effect.parameters[0]
    return first.neutral != 1.0 and first.low >= 0.0


def _fitted(
    chosen: NoiselessLog, promising: Sequence[tuple[tuple[str, ...], Parts]], workers: Workers
) -> tuple[Equivalent, ...]:
    """Those of the promising sets that are equivalent, or nearly so with fewer effects than were chosen;
    smaller sets before larger ones.
    """
    found, near = list[Equivalent](), list[Equivalent]()
    for size in range(1, EQUIVALENT_SIZE + 1):
        waiting = [
            (names, start)
            for names, start in promising
            if len(names) == size and not any(set(known.names) < set(names) for known in found)
        ]
        tasks = [Task(effects=n, arguments=(chosen, n, start)) for n, start in waiting[:EQUIVALENT_FITS]]
        results = workers.each("what cannot be told apart", _fit, tasks)
        fitted = [r for r in results if not isinstance(r, Failure)]
        found += [one for one in fitted if _is_equal(chosen, one)]
        near += [replace(one, told_apart=True) for one in fitted if _is_nearly_equal(chosen, one)]
    return (*found, *near)


def _fit(chosen: NoiselessLog, names: tuple[str, ...], start: Parts) -> Equivalent:
    problem = chosen.problem
    begin = problem.parameterization(names).joined({**chosen.kept, **start})
    fit = fit_effects(problem, names, begin, most_iterations=_ITERATIONS)
    return Equivalent(names=names, parts=fit.parts, cost=fit.cost - chosen.prior)


def _is_equal(chosen: NoiselessLog, one: Equivalent) -> bool:
    return one.cost <= min(SIMPLE_LEAD, EQUIVALENT_LEAVES * chosen.power)


def _is_nearly_equal(chosen: NoiselessLog, one: Equivalent) -> bool:
    """Whether fewer effects change nearly the same, and a real log might not tell them apart."""
    fewer = len(one.names) < len(chosen.own)
    return fewer and not _is_equal(chosen, one) and one.cost <= EQUIVALENT_LEAVES * chosen.power
