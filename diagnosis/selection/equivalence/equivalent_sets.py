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

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from diagnosis.criteria.fitting import SCATTER
from diagnosis.criteria.selection import (
    EQUIVALENT_FITS,
    EQUIVALENT_LEAVES,
    EQUIVALENT_SIZE,
    SIMPLE_LEAD,
)
from diagnosis.effects import FITTED, IMPERFECTIONS, LIBRARY
from diagnosis.effects.effect import Effect
from diagnosis.fitting.fit import fit_effects
from diagnosis.fitting.nuisance import CONVENTIONS
from diagnosis.fitting.parameterization import starts
from diagnosis.fitting.problem import FitProblem
from diagnosis.prepare.prepared_log import PreparedTrial
from diagnosis.replay.replay import predict
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.selection.candidate import Candidate
from diagnosis.selection.equivalence.column_sets import beside, combinations_within
from diagnosis.workers import Failure, Task, Workers

Array = NDArray[np.float64]
Parts = dict[str, Array]

_DIFFERENCE = 1e-3  # of the nuisance, in the units of a fit
_SMALL = 0.2  # share of a start at which the effect of a scale, or of a filter, is straight
_ALIKE = 0.9  # correlation of two changes from which one is taken as strong as the other
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


@dataclass(frozen=True, kw_only=True, eq=False)
class _Column:
    """What an effect changes, and the vector part at which it does so."""

    name: str
    part: Array
    change: Array


@dataclass(frozen=True, kw_only=True, eq=False)
class _Chosen:
    """The chosen explanation, as a log of its own.

    Attributes:
      problem: whose readings are those that it predicts.
      own: parts of its named effects.
      kept: of what is open besides.
      changed: what its named effects change of all readings, / sigma, (N,).
      middle: the same of half of each of them.
    """

    problem: FitProblem
    own: Parts
    kept: Parts
    changed: Array
    middle: Array

    @property
    def prior(self) -> float:
        """Cost of what is open besides."""
        parameterization = self.problem.parameterization(())
        weighted = parameterization.weights * parameterization.joined(self.kept)
        return float(weighted @ weighted)

    @property
    def halved(self) -> Parts:
        """All of it, with half of each named effect."""
        return _halved(self.problem, self.own) | self.kept


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
    if _names_scatter(best):
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


def _names_scatter(best: Candidate) -> bool:
    """Whether it names stiffness or damping that every fit leaves open."""
    return bool({*SCATTER} & ({*best.named} - {*best.names}))


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
    chosen = _chosen(coarse, best, whole, scatters=scatters)
    tasks = [Task(effects=(name,), arguments=(chosen, name)) for name in effects]
    results = workers.each("what cannot be told apart", _column, tasks)
    columns = [c for c in results if not isinstance(c, Failure) and c.change.any()]
    return _fitted(chosen, _promising(chosen, columns), workers) if columns else ()


def covers(names: Sequence[str], others: Sequence[str]) -> bool:
    """Whether each of the others is among the names, or contained in one that is."""
    return set(others) <= {inner for n in names for inner in (n, *FITTED[n].contains)}


def _chosen(
    coarse: FitProblem, best: Candidate, whole: tuple[str, ...], *, scatters: bool = True
) -> _Chosen:
    """Without pasts, and without scatter where it does not name it: what is alike is alike without them.

    Args:
      scatters: whether stiffness and damping that it names may be what scatters about another set.
    """
    sensors = (coarse.library[n] for n in best.names if n not in LIBRARY or n in whole)
    own = {name: best.fit.parts[name] for name in best.named if name not in whole}
    allowed = {*CONVENTIONS, *(SCATTER if scatters and _names_scatter(best) else ())}
    open_ = (*sensors, *(e for e in coarse.nuisance if e.name in allowed))
    kept = {e.name: best.fit.parts[e.name] for e in open_ if e.name not in own}
    # Without noise, slopes of runs half as fine would lead nowhere near the end.
    problem = replace(coarse, nuisance=open_, differences_halved=False)
    rig = _rig(problem, own | kept)
    trials = tuple(_reading(problem, trial, rig) for trial in coarse.log.trials)
    problem = replace(problem, log=replace(coarse.log, trials=trials))
    changed = _readings(problem, kept)
    middle = _readings(problem, _halved(problem, own) | kept)
    return _Chosen(problem=problem, own=own, kept=kept, changed=changed, middle=middle)


def _halved(problem: FitProblem, parts: Parts) -> Parts:
    return {name: problem.library[name].weakened(part, 0.5) for name, part in parts.items()}


def _reading(problem: FitProblem, trial: PreparedTrial, rig: RigParameters) -> PreparedTrial:
    """A trial that reads what a rig predicts, wherever it read anything."""
    found = predict(problem.log.rig, trial, [rig], problem.resolution)[0]
    read = {s: np.where(np.isfinite(own), found[s], np.nan) for s, own in trial.readings.items()}
    return replace(trial, readings=read)


def _rig(problem: FitProblem, parts: Parts) -> RigParameters:
    open_ = {e.name for e in problem.nuisance}
    parameterization = problem.parameterization([name for name in parts if name not in open_])
    return parameterization.rig(parameterization.joined(parts))


def _readings(problem: FitProblem, parts: Parts) -> Array:
    """What the chosen explanation reads more than a rig with these parts, / sigma, (N,)."""
    return np.concatenate([trial[0] for trial in problem.residuals([_rig(problem, parts)])])


def _column(chosen: _Chosen, name: str) -> _Column:
    """What an effect changes beside half of what was chosen.

    One that changes alike is taken as strong as that half: what friction changes is not straight.
    """
    effect = chosen.problem.library[name]
    if name in chosen.own:
        return _column_at(chosen, name, chosen.halved[name], chosen.own[name])
    each = starts(effect)
    share = _SMALL if effect.parameters[0].neutral == 1.0 or name in IMPERFECTIONS else 1.0
    first = _column_at(chosen, name, effect.weakened(each[len(each) // 2], share))
    amount = _amount(first.change, chosen.middle)
    return first if amount is None else _column_at(chosen, name, effect.weakened(first.part, amount))


def _column_at(chosen: _Chosen, name: str, part: Array, there: Array | None = None) -> _Column:
    """What an effect with this part of the vector changes; `there`: which it then has in all."""
    whole = chosen.halved | {name: part if there is None else there}
    return _Column(name=name, part=part, change=chosen.middle - _readings(chosen.problem, whole))


def _amount(change: Array, wanted: Array) -> float | None:
    """Times a change that comes nearest to what is wanted; None: it changes in another way."""
    power, common = float(change @ change), float(change @ wanted)
    if common <= _ALIKE * math.sqrt(power * float(wanted @ wanted)):
        return None
    return common / power


def _promising(chosen: _Chosen, columns: Sequence[_Column]) -> list[tuple[tuple[str, ...], Parts]]:
    """Sets of effects, and where to start their fits: by linear algebra."""
    problem = chosen.problem
    if not columns:
        return []
    slopes, weights = _open(chosen)
    changes = np.stack([chosen.changed, *(c.change for c in columns)], axis=1)
    target, *others = beside(slopes, weights, changes).T
    one_sided = np.array([_one_sided(problem.library[c.name]) for c in columns])
    allowed = max(SIMPLE_LEAD, EQUIVALENT_LEAVES * float(chosen.changed @ chosen.changed))
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


def _open(chosen: _Chosen) -> tuple[Array, Array]:
    """What is open besides: slopes of the readings, (N, k), and weights of the prior, (k,)."""
    parameterization, half = chosen.problem.parameterization(()), chosen.halved
    x = parameterization.joined(half)
    _, high = parameterization.bounds()
    steps = np.where(x + _DIFFERENCE > high, -_DIFFERENCE, _DIFFERENCE)
    slopes = np.zeros((chosen.middle.size, x.size))
    for i, step in enumerate(np.diag(steps)):
        moved = _readings(chosen.problem, half | parameterization.parts(x + step))
        slopes[:, i] = (chosen.middle - moved) / steps[i]
    return slopes, parameterization.weights


def _one_sided(effect: Effect) -> bool:
    """Whether the strength of an effect has one sign."""
    first = effect.parameters[0]
    return first.neutral != 1.0 and first.low >= 0.0


def _fitted(
    chosen: _Chosen, promising: Sequence[tuple[tuple[str, ...], Parts]], workers: Workers
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


def _fit(chosen: _Chosen, names: tuple[str, ...], start: Parts) -> Equivalent:
    problem = chosen.problem
    begin = problem.parameterization(names).joined({**chosen.kept, **start})
    fit = fit_effects(problem, names, begin, most_iterations=_ITERATIONS)
    return Equivalent(names=names, parts=fit.parts, cost=fit.cost - chosen.prior)


def _is_equal(chosen: _Chosen, one: Equivalent) -> bool:
    power = float(chosen.changed @ chosen.changed)
    return one.cost <= min(SIMPLE_LEAD, EQUIVALENT_LEAVES * power)


def _is_nearly_equal(chosen: _Chosen, one: Equivalent) -> bool:
    """Whether fewer effects change nearly the same, and a real log might not tell them apart."""
    power = float(chosen.changed @ chosen.changed)
    fewer = len(one.names) < len(chosen.own)
    return fewer and not _is_equal(chosen, one) and one.cost <= EQUIVALENT_LEAVES * power
