"""Detection limits: how strong each further effect may be and still go unseen in a log.

An effect in addition to the best fit changes the residual by d, of which the fit's own parameters can
take nothing back. Fitted, it reduces the cost by about d'd. It is named if that exceeds the
complexity penalty and the odds by which a richer explanation has to lead; as the second of two
effects, if it also exceeds the threshold of the search. Noise changes sqrt(d'd) by one standard
deviation: an effect whose sqrt(d'd) exceeds the requirement by 1.64 is seen in 95 of 100 logs. The
strength that gives this value is found by simulating the effect weaker or stronger.

If it were there, the named parameters would be others: by what the fit takes back of its change. Their
intervals hold without it.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from diagnosis.criteria.assessment import DETECTION_SIGMA
from diagnosis.criteria.fitting import SCATTER
from diagnosis.criteria.selection import SECOND_LEAVES, SIMPLE_LEAD
from diagnosis.effects import LIBRARY
from diagnosis.effects.effect import Parameter
from diagnosis.fitting.fit import Fit
from diagnosis.fitting.problem import FitProblem
from diagnosis.fitting.projection import Projection
from diagnosis.selection.scoring.complexity import most_penalty
from diagnosis.workers import Failure, Task, Workers

Array = NDArray[np.float64]

_ROUNDS = 4  # sizes grow with the strength, but for dry friction below what breaks loose
_MOST = 30.0  # times weaker or stronger in one round


@dataclass(frozen=True, kw_only=True)
class DetectionLimit:
    """The largest strength of an effect that may go unseen.

    Attributes:
      parameters: its parameters there, those of shape at the start of fits; none: any strength within
        bounds may go unseen.
      beside: what parameters of the effects that were fitted would then be, by effect.
    """

    parameters: Mapping[str, float]
    beside: Mapping[str, Mapping[str, float]] = field(default_factory=dict)


def detection_limits(
    coarse: FitProblem, best: Fit, base: Fit, effects: Sequence[str], workers: Workers
) -> dict[str, DetectionLimit]:
    """Detection limits of all further effects, by name.

    Stiffness and damping are left out, since every fit varies them. Beside two effects nothing is
    computed: detection limits of a third are not searched for.
    """
    if len(best.names) > 1:
        return {}
    others = [name for name in effects if name in LIBRARY and name not in (*best.names, *SCATTER)]
    tasks = [Task(effects=(name,), arguments=(coarse, best, base, name)) for name in others]
    results = workers.each("detection limits", detection_limit, tasks)
    return dict(limit for limit in results if not isinstance(limit, Failure))


def detection_limit(coarse: FitProblem, best: Fit, base: Fit, name: str) -> tuple[str, DetectionLimit]:
    """An effect, and the largest strength of it that may go unseen.

    Args:
      coarse: the decimated log.
      best: fit that explains the log itself, of one effect or none.
      base: the same fit on the decimated log.

    Raises:
      SimulationFailed: the effect cannot be simulated.
    """
    projection = Projection(base, name)
    parameterization = coarse.parameterization((*base.names, name))
    asked = math.sqrt(_asked(best, base, name)) + DETECTION_SIGMA
    parameters, share = coarse.library[name].parameters, 1.0
    for _ in range(_ROUNDS):
        values = [p.towards_neutral(p.start[0], share) for p in parameters]
        if _beyond_bounds(parameters, share):
            return name, DetectionLimit(parameters={})
        own = np.array([p.to_fit(v) for p, v in zip(parameters, values, strict=True)])
        rig = parameterization.rig(parameterization.joined(base.parts | {name: own}))
        runs = [run[0] for run in coarse.residuals([rig], callback_alone=True)]
        more = asked / max(float(np.linalg.norm(projection.beyond(runs))), 1e-9)
        more = float(np.clip(more, 1 / _MOST, _MOST))
        share *= more
    if _beyond_bounds(parameters, share):
        return name, DetectionLimit(parameters={})
    return name, DetectionLimit(
        parameters={p.name: p.towards_neutral(p.start[0], share) for p in parameters if p.reported},
        beside=_reported(base, base.x + more * projection.answer(runs)),
    )


def _beyond_bounds(parameters: Sequence[Parameter], share: float) -> bool:
    """Whether an effect that is so many times as strong as at its start is beyond its range."""
    values = ((p, p.towards_neutral(p.start[0], share)) for p in parameters)
    return share > 1.0 and not all(p.low <= value <= p.high for p, value in values)


def _reported(fit: Fit, x: Array) -> dict[str, dict[str, float]]:
    """Reported parameters of the effects of a fit, and of stiffness and damping, within their bounds."""
    own, found = fit.parameterization, dict[str, dict[str, float]]()
    values = own.values(np.clip(x, *own.bounds()))
    for owner, parameter, value in zip(own.owners, own.parameters, values, strict=True):
        if owner in LIBRARY and parameter.reported:
            found.setdefault(owner, {})[parameter.name] = value
    return found


def _asked(best: Fit, base: Fit, name: str) -> float:
    """Reduction of the cost that an effect needs to be named."""
    names = (*best.names, name)
    asked = most_penalty(names, best.samples) + SIMPLE_LEAD
    asked -= most_penalty(best.names, best.samples)
    return max(asked, (1 - SECOND_LEAVES) * base.cost) if best.names else asked
