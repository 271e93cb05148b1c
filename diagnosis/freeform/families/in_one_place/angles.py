"""Free laws of a torque that depends on the angle of the shaft, beside those of angle.py.

- where the shaft enters, or in its sheath, with one and two waves per turn: a bent shaft in a guide
- at the tip, or along the inserted shaft, over many turns: fibres that are wound up, a spring

A law over many turns is smooth over the angles that the base takes: sines and cosines of which the
slowest has a quarter of a wave from 0 to the largest of them.
"""

from collections.abc import Sequence
from dataclasses import replace
from functools import partial

import numpy as np

from diagnosis.effects.effect import Effect, Place
from diagnosis.freeform.families.angle import ALONG, over_angles, shown_deg, waves_over
from diagnosis.freeform.families.in_one_place.rubbing import SPOTS, Spot
from diagnosis.freeform.families.in_one_place.tip import AT_TIP_MM
from diagnosis.freeform.family import Family, coordinates, most_probable
from diagnosis.freeform.ranges import LogRanges
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.replay.variables import Variable

_QUARTER_DEG = 90.0
_SLOW_WAVES = (1, 2, 3, 4)
_SHOWN = np.linspace(-1.0, 1.0, 49)
_FIBRES = {Place.TISSUE: 0.6, Place.NEEDLE: 0.4}


def families(ranges: LogRanges) -> tuple[Family, ...]:
    """All of them, if the base turns."""
    if Variable.BASE_ANGLE not in ranges.ends:
        return ()
    bent = (_bent(spot, ranges) for spot in SPOTS)
    return (*bent, _wound(ranges, tip=True), _wound(ranges, tip=False))


def _bent(spot: Spot, ranges: LogRanges) -> Family:
    return Family(
        effect=Effect(
            name=f"{spot.name} towards one angle over base_angle",
            title=f"a torque {spot.words} that depends on the angle of the shaft",
            place=most_probable(spot.places),
            parameters=coordinates(2 * len(ALONG), 0, spot.dry(ranges).start[-1]),
            apply=partial(_apply_bent, spot),
        ),
        places=spot.places,
        says=Variable.BASE_ANGLE,
        title=f"torque {spot.words}",
        curve=partial(over_angles, shown_deg(ranges), ALONG),
        x_unit="deg",
        unit=spot.unit,
    )


def _apply_bent(spot: Spot, rig: RigParameters, *c: float) -> RigParameters:
    return replace(rig, free=spot.with_laws(*waves_over(ALONG, c)))


def _wound(ranges: LogRanges, *, tip: bool) -> Family:
    farthest_deg = max(abs(end) for end in ranges.ends[Variable.BASE_ANGLE])
    waves = tuple(n * _QUARTER_DEG / farthest_deg for n in _SLOW_WAVES)
    level = ranges.dry_level.start[-1]
    where = "tip torque" if tip else "torque along the shaft"
    return Family(
        effect=Effect(
            name=f"{where} over tip_angle, over many turns",
            title=f"{where} that depends on the angle turned, as of a spring",
            place=Place.TISSUE,
            parameters=coordinates(2 * len(waves), 0, level * (AT_TIP_MM if tip else 1.0)),
            apply=partial(_apply_wound, waves, tip),
        ),
        places=_FIBRES,
        says="tip_angle",
        title=where,
        curve=partial(over_angles, farthest_deg * _SHOWN, waves),
        x_unit="deg",
        unit="N mm" if tip else "N mm / mm",
    )


def _apply_wound(waves: Sequence[float], tip: bool, rig: RigParameters, *c: float) -> RigParameters:
    laws = waves_over(waves, c)
    return replace(rig, free=FreeLaw(at_tip=laws) if tip else FreeLaw(throughout=laws))
