"""A coupling between drive and needle whose spring hardens, as rubber does,

    torque = k (angle + angle^3 / a^2),

with the angle a at which it is twice as stiff on average as at first. There the torque is T = 2 k a, and

    angle = (2 a / sqrt(3)) sinh(asinh(3 sqrt(3) torque / T) / 3).

A smooth curve over the torque rounds off how fast it gives way about 0.
"""

import math
from dataclasses import replace
from functools import partial

import numpy as np
from numpy.typing import NDArray

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.freeform.family import Family
from diagnosis.freeform.ranges import LogRanges
from diagnosis.replay.curve import ActsOn, Curve
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.replay.variables import UNITS, Variable

Array = NDArray[np.float64]

_ANGLES_DEG, _TORQUES = (2.0, 8.0, 20.0), (0.3, 0.1, 0.02)  # to start with; torques of the largest
_LEAST_TORQUE, _MOST_TORQUE = 1e-3, 10.0
_BEYOND = 1.5  # torque that the curve spans / that of the nominal rig
_PLACES, _CLOSER = 41, 4.0  # of the curve, closer to each other about 0


def families(ranges: LogRanges) -> tuple[Family, ...]:
    """The law, if the torque of a log has ends."""
    if Variable.TORQUE not in ranges.ends:
        return ()
    most_n_mm = max(abs(end) for end in ranges.ends[Variable.TORQUE])
    starts = [(deg, share * most_n_mm) for deg in _ANGLES_DEG for share in _TORQUES]
    angles_deg, torques_n_mm = zip(*starts, strict=True)
    angle = Parameter(
        name="angle", unit="deg", low=0.05, high=180.0, start=angles_deg, logarithmic=True, neutral=None
    )
    torque = Parameter(
        name="torque",
        unit="N mm",
        low=_LEAST_TORQUE * most_n_mm,
        high=_MOST_TORQUE * most_n_mm,
        start=torques_n_mm,
        logarithmic=True,
        neutral=None,
    )
    reach_n_mm = _BEYOND * most_n_mm
    family = Family(
        effect=Effect(
            name="spring that hardens over torque",
            title="a coupling between drive and needle that hardens",
            place=Place.DRIVE,
            parameters=(angle, torque),
            apply=partial(_apply, reach_n_mm),
        ),
        places={Place.DRIVE: 1.0},
        says=Variable.TORQUE,
        title="angle by which the coupling gives way",
        curve=partial(_given_way, reach_n_mm),
        x_unit=UNITS[Variable.TORQUE],
        unit="deg",
    )
    return (family,)


def _given_way(most_n_mm: float, angle_deg: float, torque_n_mm: float) -> tuple[Array, Array]:
    """Torques, either way, and the angles by which the coupling gives way."""
    share = np.sinh(_CLOSER * np.linspace(-1.0, 1.0, _PLACES)) / math.sinh(_CLOSER)
    torques = np.asarray(most_n_mm * share)
    return torques, angle_deg * _angles(torques / torque_n_mm)


def _angles(torques: Array) -> Array:
    """Angles of the spring, in that and the torque at which it is twice as stiff, (N,)."""
    return np.asarray(2 / math.sqrt(3) * np.sinh(np.arcsinh(3 * math.sqrt(3) * torques) / 3))


def _apply(most_n_mm: float, rig: RigParameters, angle_deg: float, torque_n_mm: float) -> RigParameters:
    torques, angles_deg = _given_way(most_n_mm, angle_deg, torque_n_mm)
    own = Curve(
        acts_on=ActsOn.DRIVE_ANGLE,
        variable=Variable.TORQUE,
        places=tuple(torques.tolist()),
        values=tuple((-angles_deg).tolist()),
    )
    return replace(rig, free=FreeLaw(curves=(own,)))
