"""How much an effect could explain, at a glance: no fit, one simulation a start.

On top of a fit with residual r and Jacobian J, an effect at a start moves the
residual by d. What is left of r once d in any positive amount is taken off, and J in any
that keeps parameters within bounds, tells which effects are worth a fit, and the starts
that leave least are where to begin it: as many as the effect has parameters, since fits
of several may get stuck in a valley.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from diagnosis.backdrop import Backdrop
from diagnosis.coordinates import coordinates_of, starts
from diagnosis.effects import LIBRARY
from diagnosis.evidence import Evidence
from diagnosis.fit import Fit
from diagnosis.predict import predicted_residuals

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class Hint:
    """A set of effects that may be worth a fit.

    Attributes:
      start: vector to start the fit from.
      cost: that the fit may come down to.
      gain: of this, by the last of the effects: what the others come down to without it, less that.
    """

    names: tuple[str, ...]
    start: Array
    cost: float
    gain: float


def glance(evidence: Evidence, base: Fit, name: str, most_starts: int | None = None) -> list[Hint]:
    """What adding an effect to a fit promises, best start first.

    Args:
      most_starts: of the effect that are looked at.

    Raises:
      SimulationFailed: the effect cannot be simulated at its starts.
    """
    effect = LIBRARY[name]
    coordinates = coordinates_of((*base.names, name), evidence.nuisance)
    # What the nuisance has found already costs no more than its prior to name.
    found = [base.parts[name]] if name in base.parts else []
    own = [*found, *starts(effect)[:most_starts]]
    columns = [coordinates.joined(base.parts | {name: s}) for s in own]
    runs = predicted_residuals(evidence, [coordinates.rig(x) for x in columns])
    backdrop = Backdrop(base, name)
    without = backdrop.promised()
    hints = []
    # What the nuisance took over from a missing effect is no good start with it.
    known = {n: base.parts[n] for n in base.names}
    for i, start in enumerate(own):
        cost = backdrop.promised([run[i] for run in runs])
        begin = coordinates.joined(known | {name: start})
        hints.append(Hint(names=(*base.names, name), start=begin, cost=cost, gain=without - cost))
    best = sorted(hints, key=lambda h: h.cost)
    return best[: len(effect.parameters)]
