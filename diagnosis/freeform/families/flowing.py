"""Free laws of tissue that gives way for good.

It flows beyond a torque that it bears at most, and does not turn back by what has flowed. Or a block of
tissue slips on its support beyond a torque T0, and takes the needle with it: it turns at a rate that
grows straight with |T| - T0.
"""

from dataclasses import replace
from functools import partial

import numpy as np
from numpy.typing import NDArray

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.freeform.family import Family, Points
from diagnosis.freeform.ranges import LogRanges
from diagnosis.replay.curve import ActsOn, Curve
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.replay.variables import UNITS, Variable

Array = NDArray[np.float64]

_FLOWS_AT = Parameter(
    name="flows_at",
    unit="deg",
    low=0.5,
    high=720.0,
    start=(20.0, 60.0, 20.0, 60.0),
    logarithmic=True,
    neutral=None,
)
_BEYOND = 1.2  # times the largest torque, at which the rate of a block that slips is told
_THRESHOLDS = (0.3, 0.6, 0.3, 0.6)  # of that torque, to start with
_SLIP_DEG_S = (3.0, 3.0, 30.0, 30.0)


def families(ranges: LogRanges) -> tuple[Family, ...]:
    """Both laws; a block slips only if there is a torque."""
    return (_flowing(ranges), *_slipping(ranges))


def _flowing(ranges: LogRanges) -> Family:
    """Tissue that flows, told by its torque over its twist."""
    return Family(
        effect=Effect(
            name="tissue that flows",
            title="elastic tissue that flows beyond a torque",
            place=Place.TISSUE,
            parameters=(*ranges.library["tissue_viscoelasticity"].parameters, _FLOWS_AT),
            apply=_apply_flow,
        ),
        places={Place.TISSUE: 1.0},
        says=Variable.TORQUE,
        title="torque of the tissue",
        curve=_torque_of_flow,
        x_unit="deg",
        unit="N mm / mm",
    )


def _torque_of_flow(stiffness: float, _: float, flows_at_deg: float) -> Points:
    most = stiffness * np.radians(flows_at_deg)
    return np.array([0.0, 1.0, 2.0]) * flows_at_deg, np.array([0.0, 1.0, 1.0]) * most


def _apply_flow(
    rig: RigParameters, stiffness: float, time_constant: float, flows_at_deg: float
) -> RigParameters:
    return replace(
        rig,
        tissue_stiffness_n_mm_per_rad_per_mm=stiffness,
        tissue_time_constant_s=time_constant,
        free=FreeLaw(flows_at_deg=flows_at_deg),
    )


def _slipping(ranges: LogRanges) -> tuple[Family, ...]:
    """A block that slips on its support, if there is a torque."""
    if Variable.TORQUE not in ranges.ends:
        return ()
    most = _BEYOND * max(abs(end) for end in ranges.ends[Variable.TORQUE])
    threshold = Parameter(
        name="threshold",
        unit="N mm",
        low=1e-3 * most,
        high=0.99 * most,
        start=tuple(share * most for share in _THRESHOLDS),
        logarithmic=True,
        neutral=None,
    )
    rate = Parameter(name="rate", unit="deg/s", low=0.0, high=500.0, start=_SLIP_DEG_S, scale=5.0)
    family = Family(
        effect=Effect(
            name="tissue slip over torque",
            title="tissue that slips on its support, and takes the needle with it",
            place=Place.TISSUE,
            parameters=(threshold, rate),
            apply=partial(_apply_slip, most),
            differences=(1e-1, 1e-2),
        ),
        places={Place.TISSUE: 1.0},
        says=Variable.TORQUE,
        title="rate at which the tissue turns",
        curve=partial(_slip, most),
        x_unit=UNITS[Variable.TORQUE],
        unit="deg/s",
    )
    return (family,)


def _slip(most: float, threshold: float, rate: float) -> tuple[Array, Array]:
    """Torques, in N mm, and rates, in deg/s: of the largest torque, the parameter."""
    torque = np.linspace(threshold, most, 4)
    one_way = rate * np.linspace(0.0, 1.0, 4)
    return np.append(-torque[::-1], torque), np.append(-one_way[::-1], one_way)


def _apply_slip(most: float, rig: RigParameters, threshold: float, rate: float) -> RigParameters:
    places, values = _slip(most, threshold, rate)
    curve = Curve(
        acts_on=ActsOn.TISSUE_SLIP, variable=Variable.TORQUE, places=tuple(places), values=tuple(values)
    )
    return replace(rig, free=FreeLaw(curves=(curve,)))
