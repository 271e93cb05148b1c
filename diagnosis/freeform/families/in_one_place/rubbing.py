"""Free laws of drag and dry friction in one place: where the shaft enters the tissue, in its sheath, or
at the tip.

- over the rate: two numbers; at the tip a curve, which is in tip.py
- over the direction: the same, stronger one way than the other

A seal, a puncture, a guide tube or a bearing along the free shaft; a tip that rubs on bone.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.freeform.families.interface import SLOW_RAD_S
from diagnosis.freeform.family import Family, Points, most_probable
from diagnosis.freeform.ranges import LogRanges
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.rig_parameters import RigParameters
from models.tissue import Interface

USUAL_RAD_S = 0.5  # at which drag is as dry friction, to start with
_ASYMMETRY = Parameter(name="asymmetry", unit="-", low=-0.95, high=0.95, start=(0.3,))


@dataclass(frozen=True, kw_only=True)
class Spot:
    """Where the shaft is rubbed.

    Attributes:
      name: of its torque.
      words: where it is.
      like: effect of the library whose dry friction is there.
      law: field of a free law.
      unit: of its torque.
    """

    name: str
    words: str
    places: Mapping[Place, float]
    like: str
    law: str
    unit: str

    def with_laws(self, *laws: Interface) -> FreeLaw:
        """A free law with these at the spot."""
        own: dict[str, Any] = {self.law: laws}
        return FreeLaw(**own)

    def dry(self, ranges: LogRanges) -> Parameter:
        """Level of dry friction, in the range of the library's."""
        return ranges.library[self.like].parameters[0]

    def drag(self, ranges: LogRanges) -> Parameter:
        """Drag, which at the usual rate is as strong; of none, a curve would change nothing."""
        dry = self.dry(ranges)
        start = tuple(value / USUAL_RAD_S for value in dry.start)
        unit = self.unit.replace("N mm", "N mm s / rad", 1)
        high = dry.high / USUAL_RAD_S
        return Parameter(name="damping", unit=unit, low=0.0, high=high, start=start, scale=start[0])


ENTRY = Spot(
    name="entry torque",
    words="where the shaft enters the tissue",
    places={Place.INTERFACE: 0.7, Place.TISSUE: 0.3},
    like="entry_friction",
    law="at_entry",
    unit="N mm",
)
SHEATH = Spot(
    name="sheath torque",
    words="along the free shaft",
    places={Place.DRIVE: 1.0},
    like="sheath_friction",
    law="in_sheath",
    unit="N mm / mm",
)
AT_THE_TIP = Spot(
    name="tip torque",
    words="at the tip",
    places={Place.NEEDLE: 1.0},
    like="entry_friction",
    law="at_tip",
    unit="N mm",
)
SPOTS = (ENTRY, SHEATH)


def families(ranges: LogRanges) -> tuple[Family, ...]:
    """Both laws of each spot, and that of the direction at the tip."""
    both = tuple(law(spot, ranges) for spot in SPOTS for law in (_rate, _direction))
    return (*both, _direction(AT_THE_TIP, ranges))


def _rate(spot: Spot, ranges: LogRanges) -> Family:
    return Family(
        effect=_rubbing(spot, "rate", (spot.drag(ranges), spot.dry(ranges))),
        places=spot.places,
        says="rate",
        title=f"torque {spot.words}",
        curve=_at_rates,
        x_unit="rad/s",
        unit=spot.unit,
    )


def _direction(spot: Spot, ranges: LogRanges) -> Family:
    dry = spot.dry(ranges)
    side = replace(_ASYMMETRY, start=_ASYMMETRY.start * len(dry.start))
    return replace(
        _rate(spot, ranges),
        effect=_rubbing(spot, "direction", (spot.drag(ranges), dry, side)),
        says="direction",
        title=f"torque {spot.words} at {SLOW_RAD_S:g} rad/s",
        curve=_both_ways,
        x_unit="-",
    )


def _rubbing(spot: Spot, over: str, parameters: tuple[Parameter, ...]) -> Effect:
    return Effect(
        name=f"{spot.name} over {over}",
        title=f"drag and dry friction {spot.words}, which may depend on the {over}",
        place=most_probable(spot.places),
        parameters=parameters,
        apply=partial(_apply, spot),
        differences=(1e-2,),
    )


def _at_rates(damping: float, level: float) -> Points:
    rates = np.array([0.0, 0.03, 0.1, 0.3, 1.0])
    return rates, level + damping * rates


def _both_ways(damping: float, level: float, asymmetry: float) -> Points:
    slow = level + damping * SLOW_RAD_S
    return (-1.0, 1.0), [slow * (1 - asymmetry), slow * (1 + asymmetry)]


def _apply(
    spot: Spot, rig: RigParameters, damping: float, level: float, asymmetry: float = 0.0
) -> RigParameters:
    law = Interface(viscous_n_mm_s_per_mm=damping, kinetic_n_mm_per_mm=level, asymmetry=asymmetry)
    return replace(rig, free=spot.with_laws(law))
