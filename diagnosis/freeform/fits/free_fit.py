"""A family of free-form laws fitted to a log."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from diagnosis.fitting.fit import Fit
from diagnosis.fitting.problem import FitProblem
from diagnosis.freeform.family import Family
from diagnosis.freeform.prior import well_determined

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True, eq=False)
class FreeFit:
    """A family fitted to a log.

    Attributes:
      beside: effects of the library that are in the fit as well.
      held_out: residuals / sigma by trial that the fit has not seen; None where there are none.
      gap_after: on these (`predictive_gap`); on the trials of the fit where there are none.
      final: whether it was fitted to the log itself, not the decimated one.
    """

    family: Family
    fit: Fit
    beside: tuple[str, ...] = ()
    held_out: tuple[Array, ...] | None = None
    gap_after: float = np.inf
    final: bool = False

    @property
    def score(self) -> float:
        """Least is best: the cost in units of itself, and a penalty for what the data determine."""
        return self._score(self.fit.cost)

    @property
    def promise(self) -> float:
        """The score that one more step of the fit promises."""
        return self._score(self.fit.promised_cost)

    @property
    def promised_gap(self) -> float:
        """The gap that one more step of the fit promises, with the prior."""
        return float(np.sqrt(max(self.fit.promised_cost, 0.0) / self.fit.samples))

    def _score(self, cost: float) -> float:
        samples = self.fit.samples
        freedom = well_determined(self.family, self.fit) + 2.0 * len(self.beside)
        return samples * float(np.log(cost / samples)) + freedom * float(np.log(samples))


def with_family(problem: FitProblem, family: Family) -> FitProblem:
    """The problem, its library with a family in it."""
    return replace(problem, library={**problem.library, family.name: family.effect})
