"""Explanations with an effect that hides: fitted from where it moves the named parameters.

A tip drag and less of inserted length are nearly one, so that a fit of both that begins without the one
ends there. Where an effect at its detection limit would move a named parameter by much, the pair is
fitted from that strength, and from what the named parameters would be beside it.
"""

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from diagnosis.assessment.detection_limits import DetectionLimit
from diagnosis.assessment.moved_by_hidden import hidden_that_move
from diagnosis.assessment.uncertainty.intervals import Interval
from diagnosis.fitting.fit import Fit
from diagnosis.fitting.problem import FitProblem
from diagnosis.selection.fitting import fit_all
from diagnosis.selection.state import SearchState
from diagnosis.workers import Workers

Array = NDArray[np.float64]

STAGE = "effects that hide"


def with_hidden_effects(
    found: SearchState,
    best: Fit,
    limits: Mapping[str, DetectionLimit],
    named: Mapping[str, Mapping[str, Interval]],
    workers: Workers,
) -> SearchState:
    """The state with the best beside each effect that would move what it names; itself: none would.

    Args:
      best: fit of the verdict.
      named: intervals of the parameters of the named effects.
    """
    hidden = [name for name in hidden_that_move(limits, named) if name not in best.names]
    sets = [(*best.names, name) for name in hidden]
    starts = [start_beside(found.problem, best, name, limits[name]) for name in hidden]
    calls = [(found.problem, names, x) for names, x in zip(sets, starts, strict=True)]
    return found.adding(fit_all(STAGE, calls, workers)) if calls else found


def start_beside(problem: FitProblem, best: Fit, hidden: str, limit: DetectionLimit) -> Array:
    """Where the fit with a hidden effect begins, (n,), within bounds."""
    own = problem.parameterization((*best.names, hidden))
    first = [p.to_fit(p.start[0]) for p in problem.library[hidden].parameters]
    x = own.joined(best.parts | {hidden: np.array(first)})
    told = {hidden: limit.parameters, **limit.beside}
    for i, (owner, parameter) in enumerate(zip(own.owners, own.parameters, strict=True)):
        if parameter.name in told.get(owner, {}):
            x[i] = parameter.to_fit(told[owner][parameter.name])
    return np.clip(x, *own.bounds())
