"""The tip error of a rig that is drawn from a posterior, in the motion of a protocol.

The tip should have the angle that the protocol gives for the base:

    error(t) = base angle of the protocol - angle of the tip.

Errors of the rig's encoder and of its depth are taken into account; the sensors of tip and torque
have no influence.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from diagnosis.log.nominal_rig import NominalRig
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.replay.sensing.sensors import driven
from sim.needles.run import Run
from sim.needles.setup import Setup
from sim.protocol import Protocol
from sim.schedule import Schedule
from studies.campaign.posterior.rig_posterior import RigPosterior

Array = NDArray[np.float64]

_TIMES = 201  # at which the tip error is kept


@dataclass(frozen=True, kw_only=True)
class DrawnRig:
    """A rig and a motion, for `sim.batch.simulate_each`.

    Attributes:
      nominal: nominal constants of the rig.
      motion: lengths, segments and discretisation are used, but not needle, tissue and drive.
    """

    nominal: NominalRig
    rig: RigParameters
    motion: Protocol

    def setup(self) -> Setup:
        """The model of the rig; raises InvalidValue if its values make none."""
        how = self.motion.discretisation
        return self.rig.without_sensors.setup(
            self.nominal, self.schedule(), elements=how.elements, step_s=how.step_s
        )

    def schedule(self) -> Schedule:
        """The inputs of the rig; raises SimulationFailed if the needle never reaches the tissue."""
        return self._driven

    @cached_property
    def _driven(self) -> Schedule:
        return driven(self.rig, self.motion.schedule())

    def wanted_deg(self, time_s: Array) -> Array:
        """Base angle of the protocol at these times, deg, as `time_s`."""
        asked = self.motion.schedule()
        return np.interp(time_s, asked.time_s, asked.drive)


def drawn_rig(posterior: RigPosterior, motion: Protocol, values: dict[str, float]) -> DrawnRig:
    """The rig with these parameter values; without any, the nominal rig."""
    return DrawnRig(nominal=posterior.rig, rig=posterior.rig_with(values), motion=motion)


def times_s(motion: Protocol) -> Array:
    """Times of the tip error, s, evenly spaced from start to end, (201,)."""
    asked = motion.schedule().time_s
    return np.linspace(asked[0], asked[-1], _TIMES)


def tip_error_deg(drawn: DrawnRig, run: Run) -> Array:
    """Wanted minus actual angle of the tip at `times_s`, (201,)."""
    at = times_s(drawn.motion)
    return drawn.wanted_deg(at) - np.interp(at, run.time_s, run.tip_deg)
