"""The planar controller under camera noise: median and range over the seeds."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from studies.control.steering.planar_study import PlaneApproach
from studies.control.steering.seed_spread import Spread

SETTLED_MM = 100.0  # travel after which the height counts as the one that is held


@dataclass(frozen=True, kw_only=True)
class PlanarSpread:
    """One case at one speed, over the seeds.

    Attributes:
      converged_mm: travel until the tip stays within 0.5 mm of the plane.
      never: number of seeds in which it does not.
      rms_mm: root mean square height after 100 mm of travel.
    """

    converged_mm: Spread
    never: int
    rms_mm: Spread

    @classmethod
    def of(cls, approaches: Sequence[PlaneApproach]) -> "PlanarSpread":
        """The spread over the approaches of all seeds."""
        travels = [approach.converged_mm() for approach in approaches]
        return cls(
            converged_mm=Spread.of(travels),
            never=int(np.isnan(travels).sum()),
            rms_mm=Spread.of([approach.rms_mm(SETTLED_MM) for approach in approaches]),
        )
