"""From fits of few figures to a verdict that says no more than they do.

none        the stated rig meets the figures
explained   one set of effects meets them, and no other comes near it
undecided   several do alike
unknown     none that was tried does

A fit meets its figures if a chi-square as large has a chance of 5 %, and if the paper's
own twist test does not contradict it. Alike are fits whose AICc differ by less than 6,
but for richer forms of another.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from models import published
from studies.published.experiments.figures import Figure
from studies.published.experiments.rig import STATED
from studies.published.fitting.fit import Fit
from studies.published.fitting.mechanisms import CANDIDATES

LEAST_CHANCE = 0.05
ALIKE = 6.0  # of AICc: odds of 20 to 1
CLOSED = 2.0  # spreads within which a figure counts as met
_TWIST_SPREAD = 0.02  # of the twist test: its torque is printed to 0.4 %


class Outcome(StrEnum):
    """The four verdicts."""

    NONE = "none"
    EXPLAINED = "explained"
    UNKNOWN = "unknown"
    UNDECIDED = "undecided"


@dataclass(frozen=True, kw_only=True)
class Verdict:
    """What was concluded.

    Attributes:
      best: the fit that says most for its parameters, among those that meet the figures
        if any does.
      accepted: fits that meet the figures and are alike, best first; one a set of effects
        and reading.
    """

    outcome: Outcome
    best: Fit
    accepted: tuple[Fit, ...]

    @property
    def effects(self) -> tuple[str, ...]:
        """What explains the figures; empty unless one set alone does."""
        return self.best.hypothesis.names if self.outcome is Outcome.EXPLAINED else ()

    @property
    def confusable(self) -> tuple[tuple[str, ...], ...]:
        """Sets of effects that explain the figures alike, best first."""
        sets = tuple(dict.fromkeys(f.hypothesis.names for f in self.accepted))
        return sets if self.outcome is Outcome.UNDECIDED else ()


def judge(stated: Sequence[Fit], fits: Sequence[Fit]) -> Verdict:
    """The verdict on the stated rig, in each of its readings, and on what was fitted."""
    met = [f for f in stated if meets(f)]
    if met:
        best = min(met, key=_score)
        return Verdict(outcome=Outcome.NONE, best=best, accepted=(best,))
    passing = sorted((f for f in fits if meets(f)), key=_score)
    if not passing:
        best = min(fits, key=_score)
        return Verdict(outcome=Outcome.UNKNOWN, best=best, accepted=())
    alike = [f for f in passing if f.aicc <= passing[0].aicc + ALIKE]
    accepted = tuple(f for f in alike if not any(_richer(f, g) for g in alike if g is not f))
    sets = {f.hypothesis.names for f in accepted}
    outcome = Outcome.EXPLAINED if len(sets) == 1 else Outcome.UNDECIDED
    return Verdict(outcome=outcome, best=passing[0], accepted=accepted)


def _score(fit: Fit) -> tuple[float, float]:
    return fit.aicc, fit.chi_square


def meets(fit: Fit) -> bool:
    """Whether a fit meets its figures, and the twist test."""
    return fit.p_value >= LEAST_CHANCE and math.isfinite(fit.aicc) and not contradiction(fit)


def _richer(fit: Fit, other: Fit) -> bool:
    """Whether a fit is the other one and something more, or a form that contains it."""
    names, less = fit.hypothesis.names, other.hypothesis.names
    if fit.hypothesis.base != other.hypothesis.base or len(fit.x) <= len(other.x):
        return False
    rest = set(less) - set(names)
    return all(any(r in CANDIDATES[n].contains for n in names if n in CANDIDATES) for r in rest)


def contradiction(fit: Fit) -> str:
    """What the twist test of Section II-A says against a fit; empty: nothing.

    1.24 N mm turned the base by 90 deg against a tip held 41 cm away: a measurement of
    the shaft's stiffness itself, with whatever gives between drive and shaft in series.
    """
    model = fit.hypothesis.rig(fit.x).model
    length = published.TWIST_TEST_LENGTH.value
    compliance = length / model.needle(STATED, length).rigidity_n_mm2
    compliance += 1 / model.base_stiffness if model.base_stiffness else 0.0
    torque = math.radians(published.TWIST_TEST_ANGLE.value) / compliance
    measured = published.TWIST_TEST_TORQUE.value
    if abs(torque / measured - 1) <= 3 * _TWIST_SPREAD:
        return ""
    return f"the twist test of Section II-A would have shown {torque:.2f} N mm, not {measured:g}"


def still_open(fit: Fit) -> list[Figure]:
    """Figures that a fit misses by more."""
    return [f for f, z in zip(fit.figures, fit.missed, strict=True) if np.abs(z) > CLOSED]
