"""A free law of the skin where the shaft enters, which winds up with the shaft before it slips.

A spring in series with dry friction, in one place: the torque grows with the angle up to a level.
"""

from dataclasses import replace

import numpy as np

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.freeform.family import Family, Points
from diagnosis.freeform.ranges import LogRanges
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.rig_parameters import RigParameters
from models.tissue import Interface

_TWISTS_DEG = (3.0, 12.0, 40.0)  # to start with


def families(ranges: LogRanges) -> tuple[Family, ...]:
    """The only one."""
    return (_skin(ranges),)


def _skin(ranges: LogRanges) -> Family:
    dry = ranges.library["entry_friction"].parameters[0]
    pairs = [(level, twist) for level in dry.start for twist in _TWISTS_DEG]
    levels, twists = zip(*pairs, strict=True)
    twist = Parameter(
        name="twist", unit="deg", low=0.5, high=180.0, start=twists, logarithmic=True, neutral=None
    )
    return Family(
        effect=Effect(
            name="friction at the entry over turned_by",
            title="skin that winds up with the shaft where it enters, and then slips",
            place=Place.INTERFACE,
            parameters=(replace(dry, start=levels), twist),
            apply=_apply,
            differences=(1e-2,),
        ),
        places={Place.INTERFACE: 0.6, Place.TISSUE: 0.4},
        says="history",
        title="friction where the shaft enters, after it has turned back",
        curve=_wound_up,
        x_unit="deg",
        unit="N mm",
    )


def _wound_up(level: float, twist_deg: float) -> Points:
    return (0.0, twist_deg, 2.0 * twist_deg), (0.0, level, level)


def _apply(rig: RigParameters, level: float, twist_deg: float) -> RigParameters:
    skin = Interface(
        kinetic_n_mm_per_mm=level,
        stiffness_n_mm_per_rad_per_mm=float(level / np.radians(twist_deg)),
    )
    return replace(rig, free=FreeLaw(at_entry=(skin,)))
