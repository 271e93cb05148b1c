"""Detection limits: how strong each further effect may be and still go unseen in a log.

An effect in addition to the best fit changes the residual by d, of which the fit's own parameters can
take nothing back. Fitted, it reduces the cost by about d'd. It is named if that exceeds the
complexity penalty and the odds by which a richer explanation has to lead; as the second of two
effects, if it also exceeds the threshold of the search. Noise changes sqrt(d'd) by one standard
deviation: an effect whose sqrt(d'd) exceeds the requirement by 1.64 is seen in 95 of 100 logs. The
strength that gives this value is found by simulating the effect weaker or stronger.
"""

import math
from collections.abc import Sequence

import numpy as np

from diagnosis.criteria import DETECTION_SIGMA, SCATTER, SECOND_LEAVES, SIMPLE_LEAD
from diagnosis.effects import LIBRARY
from diagnosis.fitting.fit import Fit
from diagnosis.fitting.problem import FitProblem
from diagnosis.fitting.projection import Projection
from diagnosis.selection.scoring.complexity import most_penalty
from diagnosis.workers import Failure, Task, Workers

_ROUNDS = 4  # sizes grow with the strength, but for dry friction below what breaks loose
_MOST = 30.0  # times weaker or stronger in one round


def detection_limits(
    coarse: FitProblem, best: Fit, base: Fit, effects: Sequence[str], workers: Workers
) -> dict[str, dict[str, float]]:
    """Detection limits of all further effects, by name and parameter; no parameters: any strength.

    Stiffness and damping are left out, since every fit varies them. Beside two effects nothing is
    computed: detection limits of a third are not searched for.
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
      best: fit that explains the log itself, of one effect or none.
      base: the same fit on the decimated log.

    Returns:
      The name, and values by parameter, with parameters of shape at the start of fits; no values if
      the effect may go unseen at any strength within bounds.

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
    """Reduction of the cost that an effect needs to be named."""
    names = (*best.names, name)
    asked = most_penalty(names, best.samples) + SIMPLE_LEAD
    asked -= most_penalty(best.names, best.samples)
    return max(asked, (1 - SECOND_LEAVES) * base.cost) if best.names else asked
