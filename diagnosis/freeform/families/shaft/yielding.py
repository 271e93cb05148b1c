"""A free law of a shaft that twists plastically beyond a torque.

It hardens, by a few per cent of its stiffness as metals do: without, it would yield in one place, where
it carries most, and be a needle that slips in its chuck.
"""

from dataclasses import replace

import numpy as np

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.freeform.family import Family, Points
from diagnosis.freeform.ranges import LogRanges
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.free_parts.free_shaft import FreeShaft
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.replay.variables import Variable

_YIELDS_AT = (0.85, 0.55, 0.3)  # of the largest torque, to start with
_LEAST_YIELD, _YIELD_SLOPE = 0.02, 0.4
_LEAST_SLOPE = 0.03


def families(ranges: LogRanges) -> tuple[Family, ...]:
    """The law of a shaft that yields."""
    return (_yielding(ranges),) if Variable.TORQUE in ranges.ends else ()


def _yielding(ranges: LogRanges) -> Family:
    most_n_mm = max(abs(end) for end in ranges.ends[Variable.TORQUE])
    starts = tuple(share * most_n_mm for share in _YIELDS_AT)
    torque = Parameter(
        name="torque",
        unit="N mm",
        low=_LEAST_YIELD * most_n_mm,
        high=2.0 * most_n_mm,
        start=starts,
        logarithmic=True,
        neutral=None,
    )
    slope = Parameter(
        name="slope",
        unit="-",
        low=_LEAST_SLOPE,
        high=0.98,
        start=(_YIELD_SLOPE,) * len(starts),
        neutral=1.0,
    )
    return Family(
        effect=Effect(
            name="plastic twist over torque",
            title="a shaft that twists plastically beyond a torque",
            place=Place.NEEDLE,
            parameters=(torque, slope),
            apply=_apply_yielding,
            differences=(1e-2, 1e-3),
        ),
        places={Place.NEEDLE: 1.0},
        says="torque",
        title="torque of the shaft over its twist",
        curve=_yields,
        x_unit="of the twist at which it yields",
        unit="N mm",
    )


def _yields(torque: float, slope: float) -> Points:
    twists = np.array([0.0, 1.0, 3.0])
    return twists, torque * np.array([0.0, 1.0, 1.0 + 2.0 * slope])


def _apply_yielding(rig: RigParameters, torque: float, slope: float) -> RigParameters:
    return replace(
        rig, free=FreeLaw(shaft=FreeShaft(yield_torque_n_mm=torque, yield_stiffness_ratio=slope))
    )
