"""A coupling between drive and needle whose spring hardens, as rubber does,

    torque = k (angle + angle^3 / a^2),

with the angle a at which it is twice as stiff on average as at first. There the torque is T = 2 k a, and

    angle = (2 a / sqrt(3)) sinh(asinh(3 sqrt(3) torque / T) / 3).

A smooth curve over the torque rounds off how fast it gives way about 0. Or one whose spring is linear,
and a number of times as stiff as it unwinds, as a helical one is; or that softens or stiffens, as a
smooth curve over the time or what has been turned so far,

    angle = torque / stiffness(t).
"""

import math
from dataclasses import replace
from functools import partial

import numpy as np
from numpy.typing import NDArray

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.freeform.families.interface import FADING
from diagnosis.freeform.family import Family, Points, coordinates_of
from diagnosis.freeform.ranges import LogRanges
from diagnosis.freeform.smooth_curve import SmoothCurve, smooth_curve
from diagnosis.replay.curve import ActsOn, Course, Curve
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.free_parts.free_coupling import FreeCoupling
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.replay.variables import SAYS, UNITS, Variable
from models import units

Array = NDArray[np.float64]

_OVER = (Variable.TIME, Variable.HISTORY)
_ANGLES_DEG, _TORQUES = (2.0, 8.0, 20.0), (0.3, 0.1, 0.02)  # to start with; torques of the largest
_RATIOS = (0.3, 3.0)  # to start with
_LEAST_TORQUE, _MOST_TORQUE = 1e-3, 10.0
_BEYOND = 1.5  # torque that the curve spans / that of the nominal rig
_PLACES, _CLOSER = 41, 4.0  # of the curve, closer to each other about 0


def families(ranges: LogRanges) -> tuple[Family, ...]:
    """The laws, if the torque of a log has ends."""
    if Variable.TORQUE not in ranges.ends:
        return ()
    most_n_mm = max(abs(end) for end in ranges.ends[Variable.TORQUE])
    changing = (_changing(v, most_n_mm, ranges) for v in _OVER if v in ranges.ends)
    return (_hardening(most_n_mm), _helical(most_n_mm, ranges), *changing)


def _hardening(most_n_mm: float) -> Family:
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
    return Family(
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


def _helical(most_n_mm: float, ranges: LogRanges) -> Family:
    (stiffness,) = ranges.library["base_compliance"].parameters
    starts, ratios = zip(*((k, r) for k in stiffness.start for r in _RATIOS), strict=True)
    ratio = Parameter(
        name="ratio", unit="-", low=0.02, high=50.0, start=ratios, logarithmic=True, neutral=1.0
    )
    return Family(
        effect=Effect(
            name="spring that unwinds over torque",
            title="a coupling between drive and needle that is stiffer one way than the other",
            place=Place.DRIVE,
            parameters=(replace(stiffness, start=starts, neutral=None), ratio),
            apply=_apply_helical,
        ),
        places={Place.DRIVE: 1.0},
        says=Variable.TORQUE,
        title="angle by which the coupling gives way",
        curve=partial(_given_way_helically, most_n_mm),
        x_unit=UNITS[Variable.TORQUE],
        unit="deg",
    )


def _given_way_helically(most_n_mm: float, stiffness: float, ratio: float) -> Points:
    torques = most_n_mm * np.array([-1.0, 0.0, 1.0])
    return torques, torques / stiffness / np.array([ratio, 1.0, 1.0]) / units.DEG


def _apply_helical(rig: RigParameters, stiffness: float, ratio: float) -> RigParameters:
    coupling = FreeCoupling(stiffness_n_mm_per_rad=stiffness, unwinding_ratio=ratio)
    return replace(rig, free=FreeLaw(coupling=coupling))


def _changing(variable: Variable, most_n_mm: float, ranges: LogRanges) -> Family:
    (stiffness,) = ranges.library["base_compliance"].parameters
    curve = smooth_curve(*ranges.ends[variable], fading=variable in FADING)
    own = (replace(p, start=(0.0,) * len(stiffness.start)) for p in coordinates_of(curve))
    return Family(
        effect=Effect(
            name=f"spring that changes over {variable}",
            title=f"a coupling between drive and needle that softens or stiffens with {variable}",
            place=Place.DRIVE,
            parameters=(replace(stiffness, neutral=None), *own),
            apply=partial(_apply_changing, variable, curve, _BEYOND * most_n_mm),
        ),
        places={Place.DRIVE: 1.0},
        says=SAYS.get(variable, variable),
        title="stiffness of the coupling between drive and needle",
        curve=partial(_stiffnesses, curve),
        x_unit=UNITS[variable],
        unit="N mm / rad",
    )


def _stiffnesses(curve: SmoothCurve, stiffness: float, *c: float) -> Points:
    return curve.places, stiffness * np.array(curve.factors(c))


def _apply_changing(
    variable: Variable,
    curve: SmoothCurve,
    most_n_mm: float,
    rig: RigParameters,
    stiffness: float,
    *c: float,
) -> RigParameters:
    softer = tuple(1.0 / factor for factor in curve.factors(c))
    angle_deg = most_n_mm / stiffness / units.DEG
    own = Curve(
        acts_on=ActsOn.DRIVE_ANGLE,
        variable=Variable.TORQUE,
        places=(-most_n_mm, most_n_mm),
        values=(angle_deg, -angle_deg),
        factor=Course(variable=variable, places=tuple(map(float, curve.places)), values=softer),
    )
    return replace(rig, free=FreeLaw(curves=(own,)))


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
