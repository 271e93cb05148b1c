"""Complexity penalty of an explanation: what it has to take off the cost to be worth its freedom.

log(samples) for every parameter (BIC; Schwarz 1978), plus what the choice among many costs, so that
nothing, one of all effects, one of all pairs and one of all sets of three are equally likely before the
data: one of 351 pairs fits by chance more often than one of 27 effects.
"""

import math
from collections.abc import Sequence

from diagnosis.effects import FITTED


def complexity_penalty(names: Sequence[str], samples: int) -> float:
    """Penalty of a set of effects on so many residuals, in cost."""
    freedom = sum(len(FITTED[n].reported) for n in names)
    return freedom * math.log(max(samples, 2)) + 2.0 * math.log(math.comb(len(FITTED), len(names)))
