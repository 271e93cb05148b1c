"""Contribution of each of several effects to what a log shows."""

from diagnosis.fitting.fit import change_without
from diagnosis.fitting.problem import FitProblem
from diagnosis.selection.candidate import Candidate


def strongest_first(problem: FitProblem, best: Candidate) -> tuple[str, ...]:
    """The effects that a candidate names, by how far the readings change without each."""
    names = best.named
    if len(names) < 2:
        return names
    contribution = {name: change_without(problem, best.fit, {name}) for name in names}
    return tuple(sorted(names, key=lambda name: -contribution[name]))
