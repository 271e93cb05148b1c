"""The three tissues of the comparison, for the simulator and for the other methods.

The needle is 20 cm deep, its base turns by 90 deg in 0.3 s and is held; 8 s in all.
Units here: mm, N mm, s, rad.
"""

from dataclasses import dataclass

import numpy as np

from models.needle import NITINOL
from models.tissue import Tissue

LENGTH_MM, TURN_S, END_S, TURN_RAD = 200.0, 0.3, 8.0, float(np.pi / 2)
RIGIDITY = NITINOL.rigidity_n_mm2
DAMPING = 0.01725  # N mm s / rad / mm


@dataclass(frozen=True, kw_only=True)
class Case:
    """A tissue by its numbers, per mm of shaft; 0: has none of it.

    Attributes:
      name: also of the columns and panels.
      stiffness, time_constant_s: Kelvin-Voigt tissue in series, N mm / rad and s.
      level: of dry friction on top of the viscous, N mm.
      yield_rad: presliding angle of the dry friction.
    """

    name: str
    stiffness: float = 0.0
    time_constant_s: float = 0.0
    level: float = 0.0
    yield_rad: float = float(np.radians(0.1))

    @property
    def tissue(self) -> Tissue:
        """As the simulator takes it."""
        law = {"viscous_n_mm_s_per_mm": DAMPING, "kinetic_n_mm_per_mm": self.level}
        if self.stiffness > 0:
            law["stiffness_n_mm_per_rad_per_mm"] = self.stiffness
            law["time_constant_s"] = self.time_constant_s
        return Tissue.uniform(name=self.name, **law)


SMOOTH = Case(name="viscous")
YIELDING = Case(name="Kelvin-Voigt", stiffness=0.02, time_constant_s=1.5)
DRY = Case(name="dry friction", level=0.0015)
CASES = (SMOOTH, YIELDING, DRY)
