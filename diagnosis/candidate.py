"""A fitted explanation: what it costs, and what it names."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from diagnosis.effects import LIBRARY
from diagnosis.evidence import Evidence
from diagnosis.fit import Fit
from diagnosis.held_out import held_out, information, surprise
from diagnosis.nuisance import SCATTER
from diagnosis.whiteness import Floor, floor_of
from sim.simulation import SimulationFailed

_CERTAIN = 5.0  # standard deviations
# Times what noise in the parameters explains, all parameters and trials together. What is true
# moves up to 9 where it is rough (stick and slip), mostly by 1; what only mimics it, by 15 and more.
_SURPRISING = 12.0
_LEAST = 0.003  # simulations of the same rig differ by a tenth of this


@dataclass(frozen=True, kw_only=True)
class Candidate:
    """A fitted explanation.

    Attributes:
      score: cost plus log(samples) a parameter (BIC), plus what a choice among that many
        costs: one of 171 pairs fits by chance more often than one of 19 effects.
      floor: how far its residual is above the noise.
      unseen: the same on trials that the fit has not seen; None: not looked at.
      surprise: how far these trials move, over what noise in the parameters explains.
    """

    fit: Fit
    score: float
    floor: Floor
    unseen: Floor | None = None
    surprise: float = 0.0

    @property
    def explains(self) -> bool:
        """Whether nothing beyond noise is left, also where the fit has not looked."""
        held = self.unseen is not None and self.surprise <= _SURPRISING
        return self.floor.reached and held and not self.torn

    def looked_at(self, evidence: Evidence) -> "Candidate":
        """The same with unseen trials, if it is worth it."""
        if not self.floor.reached:
            return self
        try:
            unseen = floor_of(held_out(evidence, self.fit))
        except SimulationFailed:
            return self
        return replace(self, unseen=unseen, surprise=surprise(self.fit))

    @property
    def names(self) -> tuple[str, ...]:
        """Of its effects; none for the nominal rig."""
        return self.fit.names

    @property
    def named(self) -> tuple[str, ...]:
        """Its effects, and stiffness or damping of the rig where they are off by too much.

        Beside effects that is more than scatter explains. Alone it is whatever is
        certain: the nominal rig does not fit, and this is why.
        """
        return (*self.names, *(n for n in self._open_scatter() if self._is_off(n)))

    @property
    def of_scatter(self) -> bool:
        """Whether it is stiffness or damping alone."""
        return bool(self.names) and set(self.names) <= set(SCATTER)

    @property
    def torn(self) -> bool:
        """Whether stiffness and damping are off for certain, and it is open which: a ratio shows."""
        return not self.named and self.leans

    @property
    def leans(self) -> bool:
        """Whether stiffness and damping, together, are off for certain."""
        away, spread = self._scatter()
        off = away @ np.linalg.pinv(spread) @ away > _CERTAIN**2
        return bool(off) and float(np.abs(away).sum()) > _LEAST

    def _is_off(self, name: str) -> bool:
        if self.names:
            return abs(float(self.fit.parts[name][0])) > 2 * SCATTER[name]
        away, spread = self._scatter()
        entry = self._open_scatter().index(name)
        return abs(float(away[entry])) > max(_CERTAIN * float(np.sqrt(spread[entry, entry])), _LEAST)

    def _open_scatter(self) -> list[str]:
        return [e.name for e in self.fit.coordinates.nuisance if e.name in SCATTER]

    def _scatter(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """What is open of stiffness and damping, and its covariance."""
        entries = [self.fit.coordinates.owners.index(n) for n in self._open_scatter()]
        spread = np.asarray(np.linalg.pinv(information(self.fit)), float)
        return self.fit.x[entries], spread[np.ix_(entries, entries)]


def candidate(fit: Fit) -> Candidate:
    """A fit with its score: that none, one of all effects or one of all pairs is true is as likely."""
    return Candidate(
        fit=fit, score=fit.cost + price(fit.names, fit.samples), floor=floor_of(fit.by_trial)
    )


def price(names: Sequence[str], samples: int) -> float:
    """What a set of effects has to take off the cost before it is worth its freedom."""
    freedom = sum(len(LIBRARY[n].reported) for n in names)
    return freedom * math.log(max(samples, 2)) + 2.0 * math.log(math.comb(len(LIBRARY), len(names)))
