"""Starting points of fits: their own, and the results of simpler fits."""

import numpy as np
from numpy.typing import NDArray

from studies.published.fitting.fit import FigureFit
from studies.published.fitting.hypothesis import Hypothesis, of_plastisol

Array = NDArray[np.float64]


def starts_of_single(single: Hypothesis, damping: FigureFit | None) -> list[Array]:
    """Starts of one mechanism, (k,) each: its own, and those at the damping that was fitted alone.

    Args:
      damping: fit of the damping alone in the same stated rig; None if there is none yet.
    """
    own = single.starts()
    return own if damping is None else [*own, *(np.concatenate([damping.x, x[1:]]) for x in own)]


def starts_of_pair(pair: Hypothesis, alone: dict[str, FigureFit]) -> list[Array]:
    """Starts of a pair, (k,) each: the better single fit, combined with the other's fit and starts.

    Args:
      alone: known fits of single mechanisms in the stated rig of the pair, by name; at least one of
        the pair's.
    """
    leader = min((n for n in pair.names if n in alone), key=lambda n: alone[n].chi_square)
    other = next(n for n in pair.names if n != leader)
    joined = [alone[other].x] if other in alone else []
    joined += of_plastisol(pair.base, other).starts()
    mine = alone[leader].x
    if leader == pair.names[0]:
        return [np.concatenate([mine, x[1:]]) for x in joined]
    return [np.concatenate([mine[:1], x[1:], mine[1:]]) for x in joined]
