"""What is never known exactly of a rig, and is left open in every fit.

Stiffness and damping scatter by a few per cent about the nominal. And where the
needle slides while it is twisted, it is open whose rate the tissue resists: that at
a place, as in the paper's equation (9), or that of the material that slides past;
of tissue whose depth is constant and of one that is gone deeper into apart.
"""

from dataclasses import replace

from diagnosis.effects import LIBRARY
from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.rig_log import RigLog
from diagnosis.rig_model import RigModel
from sim.discretisation import Mesh

# One standard deviation of what scatters, as a fraction; beyond two it is an effect.
SCATTER = {"stiffness_error": 0.015, "damping_error": 0.015}
# A share between 0 and 1 is as good as open with this.
CONVENTIONS = {"slip_standing": 0.5, "slip_growing": 0.5}
SPREAD = SCATTER | CONVENTIONS
_SLIDING_MM_S = 0.05


def _standing(rig: RigModel, share: float) -> RigModel:
    return replace(rig, slip_standing=share)


def _growing(rig: RigModel, share: float) -> RigModel:
    return replace(rig, slip_growing=share)


_SHARE = Parameter(name="share", unit="-", low=0.0, high=1.0, start=(0.0,))
SLIP_STANDING = Effect(
    name="slip_standing", place=Place.INTERFACE, parameters=(_SHARE,), enter=_standing
)
SLIP_GROWING = Effect(name="slip_growing", place=Place.INTERFACE, parameters=(_SHARE,), enter=_growing)


def nuisance_of(log: RigLog) -> tuple[Effect, ...]:
    """What every fit of a log leaves open."""
    sliding = [t for t in log.trials if (abs(t["speed_mm_s"]) > _SLIDING_MM_S).any()]
    growing = [t.schedule().mesh is Mesh.LAGRANGIAN for t in sliding]
    slips = [SLIP_STANDING] if not all(growing) else []
    slips += [SLIP_GROWING] if any(growing) else []
    return (*(LIBRARY[name] for name in SCATTER), *slips)
