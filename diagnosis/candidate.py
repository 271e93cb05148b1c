"""A fitted explanation: what it costs, and what it names."""

import math
from dataclasses import dataclass

import numpy as np

from diagnosis.effects import LIBRARY
from diagnosis.fit import Fit
from diagnosis.nuisance import SCATTER
from diagnosis.whiteness import Floor, floor_of


@dataclass(frozen=True, kw_only=True)
class Candidate:
    """A fitted explanation.

    Attributes:
      score: cost plus log(samples) a parameter (BIC), plus what a choice among that many
        costs: one of 171 pairs fits by chance more often than one of 19 effects.
      floor: how far its residual is above the noise.
    """

    fit: Fit
    score: float
    floor: Floor

    @property
    def names(self) -> tuple[str, ...]:
        """Of its effects; none for the nominal rig."""
        return self.fit.names

    @property
    def named(self) -> tuple[str, ...]:
        """Its effects, and a scatter of the rig that is too large to be scatter."""
        parts, open_ = self.fit.parts, {e.name for e in self.fit.coordinates.nuisance}
        beyond = [n for n in SCATTER if n in open_ and abs(parts[n][0]) > 2 * SCATTER[n]]
        return (*self.names, *beyond)


def candidate(fit: Fit) -> Candidate:
    """A fit with its score: that none, one of all effects or one of all pairs is true is as likely."""
    freedom = fit.size * float(np.log(max(fit.samples, 2)))
    score = fit.cost + freedom + 2.0 * math.log(math.comb(len(LIBRARY), len(fit.names)))
    return Candidate(fit=fit, score=score, floor=floor_of(fit.by_trial))
