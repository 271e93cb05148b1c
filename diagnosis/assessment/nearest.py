"""The nearest explanation: the best that was tried, whatever the verdict.

No model of a real rig leaves noise alone. Where the verdict is `unknown`, this still says what
comes nearest, how much of the gap it explains, and which parameters stopped at a bound. Power is
that of the nominal residual beyond noise,

    explained = (before^2 - after^2) / (before^2 - 1),    before and after in sigma.

Its intervals are wider than those of an explanation that reaches the noise floor, by what is left.
"""

from collections.abc import Mapping
from dataclasses import dataclass

from diagnosis.assessment.gap_reduction import GapReduction
from diagnosis.assessment.intervals import Interval
from diagnosis.selection.candidate import Candidate


@dataclass(frozen=True, kw_only=True)
class Nearest:
    """The best that was tried.

    Attributes:
      effects: strongest first; none: nothing improves on the nominal rig.
      parameters: intervals by effect and parameter.
      gap_after: residual / sigma that it leaves, on held-out trials.
      power_explained_percent: of the nominal residual beyond noise.
      at_bound: parameters that stopped at a bound, as effect.parameter.
    """

    effects: tuple[str, ...]
    parameters: Mapping[str, Mapping[str, Interval]]
    gap_after: float
    power_explained_percent: float
    at_bound: tuple[str, ...]


def nearest_of(
    best: Candidate,
    effects: tuple[str, ...],
    parameters: Mapping[str, Mapping[str, Interval]],
    gap: GapReduction,
) -> Nearest:
    """The best candidate, whose effects are given strongest first.

    Args:
      parameters: of everything that its fit left open, by effect.
    """
    return Nearest(
        effects=effects,
        parameters={name: parameters[name] for name in effects if name in parameters},
        gap_after=gap.after,
        power_explained_percent=_power_percent(gap),
        at_bound=tuple(p for p in best.fit.status.at_bound if p.partition(".")[0] in effects),
    )


def _power_percent(gap: GapReduction) -> float:
    """0 where the nominal rig leaves no more than noise."""
    beyond = gap.before**2 - 1.0
    if beyond <= 0:
        return 0.0
    return 100.0 * min(max((gap.before**2 - max(gap.after, 1.0) ** 2) / beyond, 0.0), 1.0)
