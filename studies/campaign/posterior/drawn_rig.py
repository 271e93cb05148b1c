"""A rig of a posterior in the motion of a protocol: how far is its tip from where it should be?

The tip should be where the base is sent; what it lacks of that is the tip error,

    error(t) = angle that the protocol asks of the base - angle of the tip.

The encoder of the rig may read another angle than its shaft turns, and its depth be another than is
believed: both are allowed for. Sensors of tip and torque do not matter here.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from diagnosis.log.nominal_rig import NominalRig
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.replay.sensors import driven
from sim.protocol import Protocol
from sim.schedule import Schedule
from sim.simulation import Run
from sim.spec import Setup
from studies.campaign.posterior.rig_posterior import RigPosterior

Array = NDArray[np.float64]

_TIMES = 201  # at which the tip error is kept


@dataclass(frozen=True, kw_only=True)
class DrawnRig:
    """A rig and a motion, for `sim.batch.simulate_each`.

    Attributes:
      nominal: what is believed of the rig.
      motion: its lengths, segments and discretisation are used, not its needle, tissue and drive.
    """

    nominal: NominalRig
    rig: RigParameters
    motion: Protocol

    def setup(self) -> Setup:
        """Raises InvalidValue where the rig makes no model."""
        how = self.motion.discretisation
        return self.rig.without_sensors().setup(
            self.nominal, self.schedule(), elements=how.elements, step_s=how.step_s
        )

    def schedule(self) -> Schedule:
        """Raises SimulationFailed where the needle never reaches the tissue."""
        return self._driven

    @cached_property
    def _driven(self) -> Schedule:
        return driven(self.rig, self.motion.schedule())

    def wanted_deg(self, time_s: Array) -> Array:
        """What the protocol asks of the base."""
        asked = self.motion.schedule()
        return np.interp(time_s, asked.time_s, asked.drive)


def drawn_rig(posterior: RigPosterior, motion: Protocol, values: dict[str, float]) -> DrawnRig:
    """The rig that has these parameters; none: the nominal rig."""
    return DrawnRig(nominal=posterior.rig, rig=posterior.rig_with(values), motion=motion)


def times_s(motion: Protocol) -> Array:
    """When the tip error is kept, evenly spaced from start to end, (201,)."""
    asked = motion.schedule().time_s
    return np.linspace(asked[0], asked[-1], _TIMES)


def tip_error_deg(drawn: DrawnRig, run: Run) -> Array:
    """Wanted minus actual angle of the tip at `times_s`, (201,)."""
    at = times_s(drawn.motion)
    return drawn.wanted_deg(at) - np.interp(at, run.time_s, run.tip_deg)
