"""The verdict on fits to few figures, which claims no more than they support.

none        the stated rig is consistent with the figures
explained   one set of mechanisms is consistent, and no other is equivalent
undecided   several are equivalent
unknown     none that was fitted is consistent with the figures

A fit is consistent with its figures if its p value is 5 % or more, and if the paper's own
twist test does not contradict it. Fits are equivalent if their AICc differ by at most 6; richer
forms of another one do not count.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from diagnosis.selection.verdicts.verdict import VerdictKind
from studies.published.criteria import EQUIVALENT_AICC, LEAST_P_VALUE, RESOLVED_SIGMA
from studies.published.experiments.measurement import MeasuredFigure
from studies.published.fitting.fit import FigureFit
from studies.published.fitting.mechanisms import OF_PLASTISOL
from studies.published.selection.twist_constraint import contradiction

__all__ = ["FigureVerdict", "VerdictKind", "by_aicc", "figure_verdict", "is_consistent", "unresolved"]


@dataclass(frozen=True, kw_only=True)
class FigureVerdict:
    """The verdict, and the fits that it is based on.

    Attributes:
      best: the fit of smallest AICc; among the consistent ones, if there are any.
      accepted: consistent and equivalent fits, best first; one per set of mechanisms and free
        length.
    """

    kind: VerdictKind
    best: FigureFit
    accepted: tuple[FigureFit, ...]

    @property
    def effects(self) -> tuple[str, ...]:
        """The mechanisms that explain the figures; empty unless exactly one set does."""
        return self.best.hypothesis.names if self.kind is VerdictKind.EXPLAINED else ()

    @property
    def confusable(self) -> tuple[tuple[str, ...], ...]:
        """Equivalent sets of mechanisms, best first; empty unless undecided."""
        sets = tuple(dict.fromkeys(f.hypothesis.names for f in self.accepted))
        return sets if self.kind is VerdictKind.UNDECIDED else ()

    @property
    def leading(self) -> tuple[FigureFit, ...]:
        """The accepted fits; if there are none, the best one."""
        return self.accepted or (self.best,)

    @property
    def odds(self) -> float:
        """Odds of the best accepted set of mechanisms against the next one; 1 if there is none."""
        others = [f.aicc for f in self.accepted if f.hypothesis.names != self.best.hypothesis.names]
        return math.exp(0.5 * (min(others) - self.best.aicc)) if others else 1.0


def figure_verdict(stated: Sequence[FigureFit], fits: Sequence[FigureFit]) -> FigureVerdict:
    """The verdict, from the stated rig with each free length and the fits."""
    consistent = [f for f in stated if is_consistent(f)]
    if consistent:
        best = min(consistent, key=by_aicc)
        return FigureVerdict(kind=VerdictKind.NONE, best=best, accepted=(best,))
    passing = sorted((f for f in fits if is_consistent(f)), key=by_aicc)
    if not passing:
        return FigureVerdict(kind=VerdictKind.UNKNOWN, best=min(fits, key=by_aicc), accepted=())
    equivalent = [f for f in passing if f.aicc <= passing[0].aicc + EQUIVALENT_AICC]
    accepted = tuple(
        f for f in equivalent if not any(_is_richer(f, g) for g in equivalent if g is not f)
    )
    sets = {f.hypothesis.names for f in accepted}
    kind = VerdictKind.EXPLAINED if len(sets) == 1 else VerdictKind.UNDECIDED
    return FigureVerdict(kind=kind, best=passing[0], accepted=accepted)


def by_aicc(fit: FigureFit) -> tuple[float, float]:
    """Sort key: AICc, then chi-square."""
    return fit.aicc, fit.chi_square


def is_consistent(fit: FigureFit) -> bool:
    """Whether a fit is consistent with its figures, and with the twist test."""
    return fit.p_value >= LEAST_P_VALUE and math.isfinite(fit.aicc) and not contradiction(fit)


def _is_richer(fit: FigureFit, other: FigureFit) -> bool:
    """Whether a fit is the other one with more mechanisms, or with one that contains the other's."""
    names, fewer = fit.hypothesis.names, other.hypothesis.names
    if fit.hypothesis.base != other.hypothesis.base or len(fit.x) <= len(other.x):
        return False
    replaced = set(fewer) - set(names)
    known = [OF_PLASTISOL[n] for n in names if n in OF_PLASTISOL]
    return all(any(r in mechanism.contains for mechanism in known) for r in replaced)


def unresolved(fit: FigureFit) -> list[MeasuredFigure]:
    """Figures whose residual is larger than two standard deviations."""
    return [f for f, z in zip(fit.figures, fit.residual, strict=True) if np.abs(z) > RESOLVED_SIGMA]
