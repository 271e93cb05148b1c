"""Contribution of each of several effects to what a log shows."""

import numpy as np

from diagnosis.fitting.parameterization import parameterization_of
from diagnosis.fitting.problem import FitProblem
from diagnosis.selection.candidate import Candidate


def strongest_first(problem: FitProblem, best: Candidate) -> tuple[str, ...]:
    """The effects that a candidate names, by how far the readings change without each."""
    names = best.named
    if len(names) < 2:
        return names
    contribution = {name: _contribution(problem, best, name) for name in names}
    return tuple(sorted(names, key=lambda name: -contribution[name]))


def _contribution(problem: FitProblem, best: Candidate, name: str) -> float:
    """Sum of squares / sigma^2 of what an effect adds to the others."""
    fit = best.fit
    kept = [e.name for e in fit.parameterization.all if e.name != name]
    nuisance = [e for e in fit.parameterization.nuisance if e.name != name]
    without = parameterization_of([n for n in best.names if n != name], nuisance, problem.library)
    rig = without.rig(without.joined({n: fit.parts[n] for n in kept}))
    runs = problem.residuals([rig])
    each = zip(runs, best.fit.by_trial, strict=True)
    return float(sum(np.sum((run[0] - residual) ** 2) for run, residual in each))
