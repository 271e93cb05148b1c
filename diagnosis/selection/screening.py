"""Screening: what an effect could explain at best, from one simulation per start and no fit.

On top of a fit with residual r and Jacobian J, an effect at a start changes the residual by d. What
is left of r once d in any positive amount is taken off, and J in any that keeps parameters within
bounds, tells which effects are worth a fit. Fits begin where this linear model leads, from the starts
that leave least: as many as the effect has parameters, since fits of several may end in a local minimum.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from diagnosis.fitting.fit import Fit
from diagnosis.fitting.noise_floor import floor_of
from diagnosis.fitting.parameterization import starts
from diagnosis.fitting.problem import FitProblem
from diagnosis.fitting.projection import Projection
from diagnosis.replay.rig_parameters import RigParameters

Array = NDArray[np.float64]

_LEAST, _MOST = 0.01, 3.0  # times a start, that a fit begins with
_WEAK = 0.2  # share of a start from which a fit begins where no more is left than noise


@dataclass(frozen=True, kw_only=True, eq=False)
class Screened:
    """A set of effects that may be worth a fit.

    Attributes:
      start: vector to start the fit from.
      cost: that the fit may come down to.
      gain: of this, by the last of the effects: what the others come down to without it, minus that.
    """

    names: tuple[str, ...]
    start: Array
    cost: float
    gain: float


def screen(problem: FitProblem, base: Fit, name: str, most_starts: int | None = None) -> list[Screened]:
    """What adding an effect to a fit could explain, best start first.

    Args:
      most_starts: of the effect that are looked at.

    Raises:
      SimulationFailed: the effect cannot be simulated at its starts.
    """
    effect = problem.library[name]
    parameterization = problem.parameterization((*base.names, name))
    # What the nuisance has found already costs no more than its prior to name.
    found = [base.parts[name]] if name in base.parts else []
    explained = floor_of(base.by_trial).reached
    share = _WEAK if explained else 1.0
    own = [*found, *(effect.weakened(start, share) for start in starts(effect)[:most_starts])]
    columns = [parameterization.joined(base.parts | {name: s}) for s in own]
    # What is left to find beside an explanation is as small as what rougher runs are off.
    exact = replace(problem, differences_halved=False) if explained else problem
    runs = _changed(exact, base, [parameterization.rig(x) for x in columns])
    projection = Projection(base, name)
    without = projection.reachable().cost
    screened = []
    for i, start in enumerate(own):
        there = projection.reachable([run[i] for run in runs])
        parts = base.parameterization.parts(base.x + there.step)
        parts[name] = effect.weakened(start, float(np.clip(there.scale, _LEAST, _MOST)))
        begin = np.clip(parameterization.joined(parts), *parameterization.bounds())
        gain = without - there.cost
        screened.append(Screened(names=(*base.names, name), start=begin, cost=there.cost, gain=gain))
    best = sorted(screened, key=lambda s: s.cost)
    return best[: len(effect.parameters)]


def _changed(problem: FitProblem, base: Fit, rigs: Sequence[RigParameters]) -> list[list[Array]]:
    """Residuals of rigs, by trial: those of the fit, and by how much runs differ from its own."""
    if problem.of_differences is problem:
        return problem.residuals(rigs, callback_alone=True)
    here = base.parameterization.rig(base.x)
    runs = problem.of_differences.residuals([here, *rigs], callback_alone=True)
    return [
        [known + (there - own) for there in others]
        for known, (own, *others) in zip(base.by_trial, runs, strict=True)
    ]


def neutral_start(problem: FitProblem, one: Screened) -> Array:
    """The start of the last effect that leaves least where the nuisance has taken over nothing.

    Raises:
      SimulationFailed: the effect cannot be simulated at its starts.
    """
    *known, name = one.names
    parameterization = problem.parameterization(one.names)
    parts = parameterization.parts(one.start)
    kept = {n: parts[n] for n in known}
    each = [parameterization.joined(kept | {name: s}) for s in starts(problem.library[name])]
    runs = problem.residuals([parameterization.rig(x) for x in each], callback_alone=True)
    costs = [sum(float(run[i] @ run[i]) for run in runs) for i in range(len(each))]
    return each[int(np.argmin(costs))]
