"""Free laws that add to an angle or a reading: of the drive, and of both sensors.

    the drive shaft turns the needle by its angle + a curve of time, angle, orientation or direction
    the torque sensor reads a torque of the drive: a curve of its angle, orientation, rate or direction
    a sensor reads what there is + a curve of it, or of time, axial speed, depth or another signal

An offset that depends on the torque is a twist that torsion by the nominal stiffness does not give:
more likely of the needle than of the sensor that shows it.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import partial

from diagnosis.effects.effect import Effect, Place
from diagnosis.freeform.family import Family, Points, coordinates
from diagnosis.freeform.ranges import LogRanges
from diagnosis.freeform.smooth_curve import SmoothCurve, periodic_curve, smooth_curve, two_values
from diagnosis.replay.free_law import ActsOn, Curve, FreeLaw
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.replay.variables import UNITS, Variable

TURN_DEG = 360.0
DRIVE, SENSOR = {Place.DRIVE: 1.0}, {Place.SENSOR: 1.0}


@dataclass(frozen=True, kw_only=True)
class Added:
    """Something added to an angle or a reading.

    Attributes:
      sensor: whose residual shows it most.
      says: variable of the vocabulary; empty: as the variable.
      period_deg: after which it repeats; 0: it does not.
    """

    acts_on: ActsOn
    variable: Variable
    sensor: str
    places: Mapping[Place, float]
    title: str
    says: str = ""
    period_deg: float = 0.0


TIP, TORQUE = "tip_angle_deg", "base_torque_n_mm"
_SHAFT = {"acts_on": ActsOn.DRIVE_ANGLE, "sensor": TIP, "places": DRIVE, "title": "angle of the drive"}
_BEARING = {
    "acts_on": ActsOn.DRIVE_TORQUE,
    "sensor": TORQUE,
    "places": DRIVE,
    "title": "torque of the drive that the needle does not feel",
}
_TIP = {"acts_on": ActsOn.TIP_READING, "sensor": TIP, "title": "error of the tip sensor"}
_TORQUE = {"acts_on": ActsOn.TORQUE_READING, "sensor": TORQUE, "title": "error of the torque sensor"}
ADDED = (
    Added(**_SHAFT, variable=Variable.TIME),
    Added(**_SHAFT, variable=Variable.BASE_ANGLE),
    Added(**_SHAFT, variable=Variable.BASE_ANGLE, period_deg=TURN_DEG),
    Added(**_SHAFT, variable=Variable.DIRECTION),
    Added(**_BEARING, variable=Variable.BASE_ANGLE),
    Added(**_BEARING, variable=Variable.BASE_ANGLE, period_deg=TURN_DEG),
    Added(**_BEARING, variable=Variable.RATE),
    Added(**_BEARING, variable=Variable.DIRECTION),
    Added(**_TIP, places=SENSOR, variable=Variable.TIME),
    Added(**_TIP, places=SENSOR, variable=Variable.TIP_ANGLE),
    Added(**_TIP, places=SENSOR, variable=Variable.TIP_ANGLE, period_deg=TURN_DEG),
    Added(**_TIP, places=SENSOR, variable=Variable.AXIAL_SPEED),
    Added(**_TIP, places=SENSOR, variable=Variable.DEPTH),
    Added(**_TIP, places=SENSOR, variable=Variable.TIP_RATE, says="rate"),
    Added(**_TIP, places={Place.SENSOR: 0.6, Place.NEEDLE: 0.4}, variable=Variable.DIRECTION),
    Added(**_TIP, places={Place.NEEDLE: 0.6, Place.SENSOR: 0.4}, variable=Variable.TORQUE),
    Added(**_TORQUE, places=SENSOR, variable=Variable.TIME),
    Added(**_TORQUE, places=SENSOR, variable=Variable.TORQUE),
    Added(**_TORQUE, places=SENSOR, variable=Variable.AXIAL_SPEED),
    Added(**_TORQUE, places=SENSOR, variable=Variable.DEPTH),
    Added(**_TORQUE, places=SENSOR, variable=Variable.TORQUE_RATE, says="history"),
)


def families(ranges: LogRanges) -> tuple[Family, ...]:
    """What may be added to an angle or a reading."""
    seen = (a for a in ADDED if a.variable in ranges.ends and a.sensor in ranges.missing)
    return tuple(family_of(a, curve_of(a, ranges), ranges) for a in seen)


def curve_of(added: Added, ranges: LogRanges) -> SmoothCurve:
    """The curve that is added, over the range of the log."""
    if added.period_deg:
        return periodic_curve(added.period_deg)
    if added.variable is Variable.DIRECTION:
        return two_values()
    return smooth_curve(*ranges.ends[added.variable])


def family_of(added: Added, curve: SmoothCurve, ranges: LogRanges) -> Family:
    """The family of one addition."""
    period = f", every {added.period_deg:g} deg" if added.period_deg else ""
    name = f"{added.acts_on.replace('_', ' ')} over {added.variable}{period}"

    return Family(
        effect=Effect(
            name=name,
            title=name,
            place=max(added.places, key=lambda place: added.places[place]),
            parameters=coordinates(curve.size, scale=ranges.missing[added.sensor]),
            apply=partial(_apply, added, curve),
        ),
        places=added.places,
        says=added.says or added.variable,
        title=added.title,
        curve=partial(_added, curve),
        x_unit=UNITS[added.variable],
        unit="N mm" if added.sensor == TORQUE else "deg",
    )


def _added(curve: SmoothCurve, *c: float) -> Points:
    return curve.places, curve.values(c)


def _apply(added: Added, curve: SmoothCurve, rig: RigParameters, *c: float) -> RigParameters:
    own = Curve(
        acts_on=added.acts_on,
        variable=added.variable,
        places=tuple(float(x) for x in curve.places),
        values=curve.values(c),
        period=curve.period,
    )
    return replace(rig, free=FreeLaw(curves=(own,)))
