"""The name of friction in the explanation that comes nearest, where a needle never slides.

The part of a dry friction that the axial motion takes is then none: friction that is shared with that
motion is dry friction, whichever of the two a search has met first. Where nothing explains a log the
plain one is told. Where both explain it, the verdict tells both.
"""

from collections.abc import Sequence
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
    names = plain_names(best.names, problem)
    if verdict.kind is not VerdictKind.UNKNOWN or names == best.names:
        return verdict
    fit = replace(best.fit, names=names, parameterization=problem.parameterization(names))
    return replace(verdict, best=replace(best, fit=fit))


def plain_names(names: Sequence[str], problem: FitProblem) -> tuple[str, ...]:
    """A set of effects, with plain dry friction in place of that which is shared with no motion."""
    slides = any(trial.slides for trial in problem.log.trials)
    if slides or _SHARED not in names or _PLAIN in names:
        return tuple(names)
    return tuple(_PLAIN if name == _SHARED else name for name in names)
