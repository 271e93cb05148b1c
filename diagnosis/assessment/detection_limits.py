"""Detection limits: how strong each further effect may be and go unseen in a log.

Beside the best fit, an effect changes the residual by d that the fit cannot take back.
Fitted, it takes about d'd off the cost, and is named if that is worth its freedom, the
choice, and the odds that a richer explanation has to lead by; as the second of two, if it
is worth a search. Noise changes sqrt(d'd) by one standard deviation: an effect whose
sqrt(d'd) is 1.64 more than asked is seen in 95 of 100 logs. Its strength is found by
simulating it weaker or stronger until it is that.
"""

import math
from collections.abc import Sequence

import numpy as np

from diagnosis.criteria import DETECTION_SIGMA, SCATTER, SECOND_LEAVES, SIMPLE_LEAD
from diagnosis.effects import LIBRARY
from diagnosis.fitting.fit import Fit
from diagnosis.fitting.problem import FitProblem
from diagnosis.fitting.projection import Projection
from diagnosis.selection.complexity import complexity_penalty
from diagnosis.workers import Failure, Task, Workers

_ROUNDS = 4  # sizes grow with the strength, but for dry friction below what breaks loose
_MOST = 30.0  # times weaker or stronger in one round


def detection_limits(
    coarse: FitProblem, best: Fit, base: Fit, effects: Sequence[str], workers: Workers
) -> dict[str, dict[str, float]]:
    """The detection limit of every further effect, by name and parameter; none: any strength.

    Stiffness and damping are left out, which every fit leaves open, and all effects beside
    two others: three at once are not searched for.
    """
    if len(best.names) > 1:
        return {}
    others = [name for name in effects if name in LIBRARY and name not in (*best.names, *SCATTER)]
    tasks = [Task(effects=(name,), arguments=(coarse, best, base, name)) for name in others]
    results = workers.each("detection limits", detection_limit, tasks)
    return dict(limit for limit in results if not isinstance(limit, Failure))


def detection_limit(coarse: FitProblem, best: Fit, base: Fit, name: str) -> tuple[str, dict[str, float]]:
    """An effect, and its parameters at the largest strength that may go unseen.

    Args:
      coarse: the decimated log.
      best: what explains the log itself, one effect or none.
      base: the same on the decimated log.

    Returns:
      The name and values by parameter, of the shape that fits start from; none if the
      effect may go unseen at any strength within bounds.

    Raises:
      SimulationFailed: the effect cannot be simulated.
    """
    projection = Projection(base, name)
    parameterization = coarse.parameterization((*base.names, name))
    asked = math.sqrt(_asked(best, base, name)) + DETECTION_SIGMA
    parameters, share = coarse.library[name].parameters, 1.0
    for _ in range(_ROUNDS):
        values = [p.towards_neutral(p.start[0], share) for p in parameters]
        if share > 1 and not all(p.low <= v <= p.high for p, v in zip(parameters, values, strict=True)):
            return name, {}
        own = np.array([p.to_fit(v) for p, v in zip(parameters, values, strict=True)])
        rig = parameterization.rig(parameterization.joined(base.parts | {name: own}))
        moved = projection.beyond([run[0] for run in coarse.residuals([rig], callback_alone=True)])
        more = asked / max(float(np.linalg.norm(moved)), 1e-9)
        share *= float(np.clip(more, 1 / _MOST, _MOST))
    return name, {p.name: p.towards_neutral(p.start[0], share) for p in parameters if p.reported}


def _asked(best: Fit, base: Fit, name: str) -> float:
    """What an effect has to take off the cost to be named."""
    names = (*best.names, name)
    asked = complexity_penalty(names, best.samples) + SIMPLE_LEAD
    asked -= complexity_penalty(best.names, best.samples)
    return max(asked, (1 - SECOND_LEAVES) * base.cost) if best.names else asked
