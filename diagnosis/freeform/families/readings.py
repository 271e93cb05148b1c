"""Free laws that are added to an angle or a reading: of the drive, the tissue and both sensors.

    drive angle    needle at the chuck = drive shaft + a curve of time, angle, orientation, direction, or
                   of depth or axial speed, as of a carriage that twists what it carries
    tissue angle   the tissue turns by a curve of time, depth or axial speed, and takes the needle along
    drive torque   the torque sensor also reads a curve of the drive's angle, rate or direction
    sensor         reading = true value + a curve of it, of time, axial speed, depth or another signal,
                   or true value times a curve of time or depth

An angle of the drive that errs with its angle, or once a turn, is as likely that of an encoder, whose
disc is off its centre; no log tells which. One that errs with the depth is an offset of the tip's
reading where the depth stays through a trial. Several waves a turn are those of gears and joints. An
offset of the tip that depends on the torque is a twist in addition to that of the nominal stiffness: it
is more likely due to the needle than to the sensor.
"""

from collections.abc import Mapping
from dataclasses import replace

from diagnosis.effects.effect import Place
from diagnosis.freeform.family import Family
from diagnosis.freeform.ranges import LogRanges
from diagnosis.freeform.templates.added_curve import (
    RIPPLE,
    SIGNED,
    TURN_DEG,
    AddedCurve,
    curve_of,
    family_of,
)
from diagnosis.log.trial import TIP, TORQUE
from diagnosis.replay.curve import ActsOn
from diagnosis.replay.variables import SAYS, Variable

DRIVE, SENSOR = {Place.DRIVE: 1.0}, {Place.SENSOR: 1.0}
_OF_ENCODER = {Place.SENSOR: 0.55, Place.DRIVE: 0.45}


def _added(
    acts_on: ActsOn,
    sensor: str,
    title: str,
    places: Mapping[Place, float],
    *variables: Variable,
    period_deg: float = 0.0,
    bent: bool = False,
) -> tuple[AddedCurve, ...]:
    return tuple(
        AddedCurve(
            acts_on=acts_on,
            variable=variable,
            sensor=sensor,
            places=places,
            title=title,
            says=SAYS.get(variable, variable),
            period_deg=period_deg,
            bent=bent or variable in SIGNED,
        )
        for variable in variables
    )


_SHAFT = (ActsOn.DRIVE_ANGLE, TIP, "error of the drive's angle")
_TISSUE = (ActsOn.TISSUE_ANGLE, TIP, "angle by which the tissue turns", {Place.TISSUE: 1.0})
_SLIP = (ActsOn.DRIVE_SLIP, TIP, "slip of the needle in its chuck")
_LOST = (ActsOn.DRIVE_SLIP, TIP, "rate at which the drive falls behind its encoder")
_SCREW = (ActsOn.TISSUE_SLIP, TIP, "rate at which the shaft is turned with respect to the tissue")
_BEARING = (ActsOn.DRIVE_TORQUE, TORQUE, "torque of the drive that the needle does not feel")
_TIP = (ActsOn.TIP_READING, TIP, "error of the tip sensor")
_TORQUE = (ActsOn.TORQUE_READING, TORQUE, "error of the torque sensor")
_V = Variable
ADDED = (
    *_added(*_SHAFT, DRIVE, _V.TIME, _V.TRIAL_SHARE, _V.DIRECTION),
    *_added(*_SHAFT, _OF_ENCODER, _V.BASE_ANGLE),
    *_added(*_SHAFT, _OF_ENCODER, _V.BASE_ANGLE, period_deg=TURN_DEG),
    *_added(*_SHAFT, DRIVE, _V.TURNED_BY, _V.TORQUE, _V.AXIAL_SPEED, _V.SLID),
    *_added(*_SHAFT, {Place.DRIVE: 0.5, Place.SENSOR: 0.5}, _V.DEPTH),
    *_added(*_SHAFT, {Place.DRIVE: 0.6, Place.NEEDLE: 0.4}, _V.PAST),
    *_added(*_SLIP, DRIVE, _V.TORQUE),
    *_added(*_LOST, {Place.DRIVE: 0.6, Place.SENSOR: 0.4}, _V.RATE),
    *_added(*_TISSUE, _V.TIME, _V.TRIAL_SHARE, _V.DEPTH, _V.AXIAL_SPEED),
    *_added(*_SCREW, {Place.INTERFACE: 0.6, Place.NEEDLE: 0.4}, _V.AXIAL_SPEED),
    *_added(*_BEARING, DRIVE, _V.BASE_ANGLE, _V.RATE, _V.ACCELERATION, _V.SLID_DIRECTION),
    *_added(*_BEARING, DRIVE, _V.BASE_ANGLE, period_deg=TURN_DEG),
    *_added(*_BEARING, DRIVE, _V.TURNED_BY, _V.THRUST),
    *_added(*_TIP, SENSOR, _V.TIME, _V.TIP_ANGLE, _V.AXIAL_SPEED, _V.DEPTH, _V.TIP_RATE, _V.PAST),
    *_added(*_TIP, SENSOR, _V.TRIAL_SHARE, _V.TURNED_BY, _V.RATE, _V.HISTORY),
    *_added(*_TIP, SENSOR, _V.TIP_ANGLE, period_deg=TURN_DEG),
    *_added(*_TIP, SENSOR, _V.BASE_ANGLE),
    *_added(*_TIP, SENSOR, _V.BASE_ANGLE, period_deg=TURN_DEG),
    *_added(*_TIP, SENSOR, _V.TIP_ANGLE, bent=True),
    *_added(*_TIP, SENSOR, _V.TIP_DIRECTION),
    *_added(*_TIP, {Place.SENSOR: 0.6, Place.NEEDLE: 0.4}, _V.DIRECTION),
    *_added(*_TIP, {Place.NEEDLE: 0.6, Place.SENSOR: 0.4}, _V.TORQUE),
    *_added(*_SHAFT, DRIVE, _V.BASE_ANGLE, period_deg=RIPPLE),
    *_added(*_BEARING, DRIVE, _V.BASE_ANGLE, period_deg=RIPPLE),
    *_added(*_TIP, SENSOR, _V.TIP_ANGLE, period_deg=RIPPLE),
    *_added(*_TORQUE, SENSOR, _V.TIME, _V.TORQUE, _V.AXIAL_SPEED, _V.DEPTH, _V.TORQUE_RATE, _V.PAST),
    *_added(*_TORQUE, SENSOR, _V.TRIAL_SHARE, _V.HISTORY, _V.AXIAL_DRAG, _V.AXIAL_FLOW),
    *_added(*_TORQUE, SENSOR, _V.TURNED_BY),
    *_added(*_TORQUE, SENSOR, _V.TIP_ANGLE, period_deg=TURN_DEG),
    *_added(ActsOn.TIP_GAIN, TIP, "gain of the tip sensor", SENSOR, _V.TIME, _V.DEPTH, _V.AXIAL_SPEED),
    *_added(
        ActsOn.TORQUE_GAIN,
        TORQUE,
        "gain of the torque sensor",
        SENSOR,
        _V.TIME,
        _V.DEPTH,
        _V.AXIAL_SPEED,
    ),
)


def families(ranges: LogRanges) -> tuple[Family, ...]:
    """Families of terms that may be added to an angle or a reading."""
    shown = (_where_it_shows(a, ranges) for a in ADDED if a.variable in ranges.ends)
    return tuple(family_of(a, curve_of(a, ranges), ranges) for a in shown if a.sensor in ranges.missing)


def _where_it_shows(added: AddedCurve, ranges: LogRanges) -> AddedCurve:
    """An angle of the drive shows in the torque, where the tip is not measured."""
    return replace(added, sensor=TORQUE) if added.of_the_drive and TIP not in ranges.missing else added
