"""How strong an effect may be and still hide in a log.

Beside the best fit, an effect moves the residual by d that the fit cannot take back.
Fitted, it takes about d'd off the cost, and is named if that is worth its freedom, the
choice, and the odds that a richer explanation has to lead by; as the second of two, if it
is worth a search. Noise moves sqrt(d'd) by one standard deviation: an effect whose
sqrt(d'd) is 1.64 more than asked is seen in 95 of 100 logs. Its strength is found by
simulating it weaker or stronger until it is that.
"""

import math
from collections.abc import Sequence

import numpy as np

from diagnosis.backdrop import Backdrop
from diagnosis.candidate import price
from diagnosis.coordinates import coordinates_of
from diagnosis.effects import LIBRARY
from diagnosis.evidence import Evidence
from diagnosis.fit import Fit
from diagnosis.nuisance import SCATTER
from diagnosis.predict import predicted_residuals
from diagnosis.search import SECOND_LEAVES
from diagnosis.team import Team
from diagnosis.verdict import ALIKE

_SURE = 1.645
_ROUNDS = 4  # sizes grow with the strength, but for dry friction below what breaks loose
_MOST = 30.0  # times weaker or stronger in one round


def hiding_beside(
    coarse: Evidence, best: Fit, base: Fit, effects: Sequence[str], team: Team
) -> dict[str, dict[str, float]]:
    """What `hidden` finds of every further effect, by name.

    Stiffness and damping are left out, which every fit leaves open, and all effects beside
    two others: three at once are not searched for.
    """
    if len(best.names) > 1:
        return {}
    others = [name for name in effects if name not in (*best.names, *SCATTER)]
    calls = [(coarse, best, base, name) for name in others]
    return dict(team.each("looking for what hides", hidden, calls))


def hidden(evidence: Evidence, best: Fit, base: Fit, name: str) -> tuple[str, dict[str, float]]:
    """An effect, and its parameters at the largest strength that a log may hide.

    Args:
      evidence: the thinned log.
      best: what explains the log itself, one effect or none.
      base: the same on the thinned log.

    Returns:
      The name and values by parameter, of the shape that fits start from; none if the log hides
      the effect at any strength within bounds.

    Raises:
      SimulationFailed: the effect cannot be simulated.
    """
    backdrop, coordinates = Backdrop(base, name), coordinates_of((*base.names, name), evidence.nuisance)
    asked = math.sqrt(_asked(best, base, name)) + _SURE
    parameters, share = LIBRARY[name].parameters, 1.0
    for _ in range(_ROUNDS):
        values = [p.at_strength(p.start[0], share) for p in parameters]
        if share > 1 and not all(p.low <= v <= p.high for p, v in zip(parameters, values, strict=True)):
            return name, {}
        own = np.array([p.forward(v) for p, v in zip(parameters, values, strict=True)])
        rig = coordinates.rig(coordinates.joined(base.parts | {name: own}))
        moved = backdrop.moved([run[0] for run in predicted_residuals(evidence, [rig])])
        more = asked / max(float(np.linalg.norm(moved)), 1e-9)
        share *= float(np.clip(more, 1 / _MOST, _MOST))
    return name, {p.name: p.at_strength(p.start[0], share) for p in parameters if p.reported}


def _asked(best: Fit, base: Fit, name: str) -> float:
    """What an effect has to take off the cost to be named."""
    names = (*best.names, name)
    asked = price(names, best.samples) - price(best.names, best.samples) + ALIKE
    return max(asked, (1 - SECOND_LEAVES) * base.cost) if best.names else asked
