"""A family of free-form laws fitted to a log, alone or beside others."""

from collections import Counter
from collections.abc import Callable, Hashable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from diagnosis.fitting.fit import Fit
from diagnosis.fitting.problem import FitProblem
from diagnosis.freeform.family import Family
from diagnosis.freeform.prior import well_determined
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.workers import Failure, Task, Workers

Array = NDArray[np.float64]
T = TypeVar("T")


@dataclass(frozen=True, kw_only=True, eq=False)
class FreeFit:
    """A family fitted to a log.

    Attributes:
      others: families of other laws that are in the fit as well, and add to it.
      beside: effects of the library that are.
      held_out: residuals / sigma by trial that the fit has not seen; None where there are none.
      gap_after: on these (`predictive_gap`); on the trials of the fit where there are none.
      final: whether it was fitted to the log itself, not the decimated one.
    """

    family: Family
    fit: Fit
    others: tuple[Family, ...] = ()
    beside: tuple[str, ...] = ()
    held_out: tuple[Array, ...] | None = None
    gap_after: float = np.inf
    final: bool = False

    @property
    def families(self) -> tuple[Family, ...]:
        """Those of all its laws, the leading one first."""
        return (self.family, *self.others)

    @property
    def with_its_law_first(self) -> "FreeFit":
        """The fit, led by a law that holds in all trials: numbers of each trial stand beside.

        A law is told by what it depends on, and an offset of each trial depends on nothing.
        """
        ranked = sorted(self.families, key=lambda family: family.of_each_trial)
        return replace(self, family=ranked[0], others=tuple(ranked[1:]))

    @property
    def curves(self) -> tuple[Family, ...]:
        """All curves that tell its laws: each law, then the factor that it may have."""
        return tuple(curve for family in self.families for curve in family.curves)

    @property
    def names(self) -> tuple[str, ...]:
        """All that are fitted: laws, then effects."""
        return (*(family.name for family in self.families), *self.beside)

    @property
    def score(self) -> float:
        """Least is best: the cost in units of itself, and a penalty for what the data determine."""
        return self._score(self.fit.cost)

    @property
    def predicted_score(self) -> float:
        """The score after one more step of the fit, by its slopes."""
        return self._score(self.fit.predicted_cost)

    @property
    def predicted_gap(self) -> float:
        """The gap after one more step of the fit, by its slopes, with the prior."""
        return float(np.sqrt(max(self.fit.predicted_cost, 0.0) / self.fit.samples))

    def _score(self, cost: float) -> float:
        samples = self.fit.samples
        freedom = sum(well_determined(family, self.fit) for family in self.families)
        freedom += 2.0 * (len(self.beside) + len(self.others))
        return samples * float(np.log(cost / samples)) + freedom * float(np.log(samples))


def few_of_each(ranked: Iterable[T], law_of: Callable[[T], Hashable], most_of_one: int) -> Iterator[T]:
    """Of each law the first so many of a ranking."""
    taken = Counter[Hashable]()
    for one in ranked:
        taken[law_of(one)] += 1
        if taken[law_of(one)] <= most_of_one:
            yield one


def each_fit(
    stage: str, function: Callable[..., FreeFit], calls: Sequence[tuple[Any, ...]], workers: Workers
) -> list[FreeFit]:
    """The fits of all calls that did not fail."""
    tasks = [Task(effects=(), arguments=call) for call in calls]
    return [f for f in workers.each(stage, function, tasks) if not isinstance(f, Failure)]


def with_family(problem: FitProblem, *families: Family) -> FitProblem:
    """The problem, its library with families in it, each of which adds to the laws that others set."""
    own = {f.name: replace(f.effect, apply=partial(_added, f.effect.apply)) for f in families}
    return replace(problem, library={**problem.library, **own})


def _added(apply: Callable[..., RigParameters], rig: RigParameters, *values: float) -> RigParameters:
    changed = apply(replace(rig, free=None), *values)
    if rig.free is None or changed.free is None:
        return replace(changed, free=changed.free or rig.free)
    return replace(changed, free=rig.free.beside(changed.free))
