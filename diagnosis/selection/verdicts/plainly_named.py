"""The name of friction in the explanation that comes nearest, where a needle never slides.

The part of a dry friction that the axial motion takes is then none: friction that is shared with that
motion is dry friction, whichever of the two a search has met first. Where nothing explains a log the
plain one is told. Where both explain it, the verdict tells both.
"""

from dataclasses import replace

from diagnosis.fitting.problem import FitProblem
from diagnosis.selection.verdicts.verdict import Verdict, VerdictKind

_SHARED, _PLAIN = "speed_dependent_friction", "coulomb_friction"


def plainly_named(verdict: Verdict, problem: FitProblem) -> Verdict:
    """A verdict that is unknown, with plain dry friction in what comes nearest; any other as it is.

    Args:
      problem: that its best was fitted to.
    """
    best = verdict.best
    if verdict.kind is not VerdictKind.UNKNOWN or any(trial.slides for trial in problem.log.trials):
        return verdict
    if _SHARED not in best.names or _PLAIN in best.names:
        return verdict
    names = tuple(_PLAIN if name == _SHARED else name for name in best.names)
    fit = replace(best.fit, names=names, parameterization=problem.parameterization(names))
    return replace(verdict, best=replace(best, fit=fit))
