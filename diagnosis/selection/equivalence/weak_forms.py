"""A richer law that is too weak to show its shape: may it be there in place of the simpler one?

A weak stiction looks like dry friction, and log(samples) for each of its parameters would rule it out
with certainty. So typical forms of the richer law take the place of the simpler one in the best
explanation, and everything else answers as its slopes say. Their evidence over that of the simpler law:

    mean of exp(-(cost of the form - cost of the simpler law) / 2).

Where the law is strong, all typical forms are far off, and nothing changes.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.special import logsumexp

from diagnosis.criteria.selection import SIMPLE_LEAD
from diagnosis.effects import LIBRARY
from diagnosis.fitting.problem import FitProblem
from diagnosis.fitting.projection import Projection
from diagnosis.selection.candidate import Candidate
from diagnosis.selection.richer_forms import forms_beyond, with_richer

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True, eq=False)
class WeakForm:
    """A richer law in place of a simpler one.

    Attributes:
      score: of its typical forms together.
      start: vector of the likeliest of them.
    """

    names: tuple[str, ...]
    score: float
    start: Array


def weak_forms(problem: FitProblem, best: Candidate) -> tuple[WeakForm, ...]:
    """Richer laws in place of each simpler one of an explanation, in units of the problem's noise.

    Raises:
      SimulationFailed: a form cannot be simulated.
    """
    richer = [
        (simple, rich)
        for simple in best.names
        for rich, effect in LIBRARY.items()
        if simple in effect.contains and rich not in best.names
    ]
    return tuple(_weak_form(problem, best, simple, rich) for simple, rich in richer)


def with_their_scores(candidates: Sequence[Candidate], forms: Sequence[WeakForm]) -> list[Candidate]:
    """Candidates, best first; of a richer law the evidence of its weak forms adds to that of its fit."""
    weak = {frozenset(form.names): form.score for form in forms}
    least = min(c.score for c in candidates)

    def scored(one: Candidate) -> Candidate:
        known = weak.get(frozenset(one.names))
        if known is None:
            return one
        together = float(-2.0 * np.logaddexp(-0.5 * one.score, -0.5 * known))
        return replace(one, score=together, shape_open=known - least <= SIMPLE_LEAD)

    return sorted(map(scored, candidates), key=lambda c: c.score)


def _weak_form(problem: FitProblem, best: Candidate, simple: str, rich: str) -> WeakForm:
    names = with_richer(best, simple, rich)
    parameterization = problem.parameterization(names)
    forms = forms_beyond(problem, best, simple, rich)
    runs = problem.residuals([parameterization.rig(x) for x in forms])
    projection = Projection(best.fit, rich)
    costs = np.array([projection.answered_cost([run[i] for run in runs]) for i in range(len(forms))])
    more = costs - projection.answered_cost(best.fit.by_trial)
    behind = -2.0 * float(logsumexp(-0.5 * more) - np.log(len(forms)))
    return WeakForm(names=names, score=best.score + behind, start=forms[int(np.argmin(costs))])
