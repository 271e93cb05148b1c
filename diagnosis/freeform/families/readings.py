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
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from diagnosis.effects.effect import Effect, Place
from diagnosis.freeform.family import Family, Points, coordinates_of, most_probable
from diagnosis.freeform.ranges import LogRanges
from diagnosis.freeform.ripple import waves_in_a_turn
from diagnosis.freeform.smooth_curve import (
    SmoothCurve,
    bent_curve,
    jumping_curve,
    periodic_curve,
    separate_values,
    smooth_curve,
    three_values,
    two_values,
)
from diagnosis.log.trial import TIP, TORQUE
from diagnosis.replay.curve import FACTORS, ActsOn
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.replay.variables import SAYS, UNITS, Variable

TURN_DEG = 360.0
RIPPLE = -1.0  # a period that is looked for in what the nominal rig leaves
PLACES, PAST_PLACES, RIPPLE_PLACES = 12, 12, 5
TURNED_BY = np.geomspace(0.25, 8.0, 10)  # of the rms of what is missing
DRAGGED_DEG = np.geomspace(0.5, 180.0, 10)  # turn of the drive over which its friction builds up
SIGNED = (
    Variable.TORQUE,
    Variable.TORQUE_RATE,
    Variable.RATE,
    Variable.TIP_RATE,
    Variable.ACCELERATION,
    Variable.AXIAL_SPEED,
    Variable.AXIAL_DRAG,
    Variable.AXIAL_FLOW,
    Variable.THRUST,
)
"""Variables whose signs a machine may take differently; an angle's zero is where somebody put it."""
_RATES = (Variable.RATE, Variable.TIP_RATE)  # friction changes fastest where these are small
_OF_DIRECTION = {
    Variable.DIRECTION: two_values,
    Variable.TIP_DIRECTION: two_values,
    Variable.SLID_DIRECTION: three_values,
}
_SLIPS = (ActsOn.DRIVE_SLIP, ActsOn.TISSUE_SLIP)
DRIVE, SENSOR = {Place.DRIVE: 1.0}, {Place.SENSOR: 1.0}
_OF_ENCODER = {Place.SENSOR: 0.55, Place.DRIVE: 0.45}


@dataclass(frozen=True, kw_only=True)
class Added:
    """A term that is added to an angle or a reading.

    Attributes:
      sensor: the sensor whose residual shows it most.
      says: variable of the vocabulary.
      period_deg: period; 0: none; RIPPLE: that of the strongest ripple per turn in the residual.
      bent: whether the curve may bend at zero: of the variables in `SIGNED` it always may.
    """

    acts_on: ActsOn
    variable: Variable
    sensor: str
    places: Mapping[Place, float]
    title: str
    says: str
    period_deg: float = 0.0
    bent: bool = False

    @property
    def of_the_drive(self) -> bool:
        """Whether it is an angle of the drive, or its rate, or one that is as good as that."""
        return self.acts_on in (ActsOn.DRIVE_ANGLE, ActsOn.TISSUE_ANGLE, *_SLIPS)


def _added(
    acts_on: ActsOn,
    sensor: str,
    title: str,
    places: Mapping[Place, float],
    *variables: Variable,
    period_deg: float = 0.0,
    bent: bool = False,
) -> tuple[Added, ...]:
    return tuple(
        Added(
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


def _where_it_shows(added: Added, ranges: LogRanges) -> Added:
    """An angle of the drive shows in the torque, where the tip is not measured."""
    return replace(added, sensor=TORQUE) if added.of_the_drive and TIP not in ranges.missing else added


def curve_of(added: Added, ranges: LogRanges) -> SmoothCurve:
    """The curve that is added, over the range of the log."""
    if added.period_deg == RIPPLE:
        return periodic_curve(
            TURN_DEG / waves_in_a_turn(ranges, added.sensor, added.variable), RIPPLE_PLACES
        )
    if added.period_deg:
        return ranges.in_detail(periodic_curve(added.period_deg))
    if added.variable in _OF_DIRECTION:
        return _OF_DIRECTION[added.variable]()
    if added.variable is Variable.TURNED_BY:
        return _hysteresis(added, ranges)
    return _over_the_range(added, ranges)


def _over_the_range(added: Added, ranges: LogRanges) -> SmoothCurve:
    low, high = ranges.ends[added.variable]
    if added.variable is Variable.PAST:
        return separate_values(np.geomspace(low, high, PAST_PLACES))
    if added.variable is Variable.AXIAL_SPEED:
        return jumping_curve(low, high, PLACES)
    if added.bent:
        curve = ranges.in_detail(bent_curve(low, high, PLACES, close=added.variable in _RATES))
        return curve.zero_at_zero() if added.acts_on in _SLIPS else curve  # nothing slips at rest
    return ranges.in_detail(smooth_curve(low, high, PLACES))


def _hysteresis(added: Added, ranges: LogRanges) -> SmoothCurve:
    """Shares of what turns, or of the friction that turning back and forth builds up in the drive."""
    if added.acts_on is ActsOn.DRIVE_TORQUE:
        return SmoothCurve(places=DRAGGED_DEG, basis=np.diag(1.0 / DRAGGED_DEG), straight=0)
    return separate_values(_size(added, ranges) * TURNED_BY)


def family_of(added: Added, curve: SmoothCurve, ranges: LogRanges) -> Family:
    """The family of one addition."""
    period = f", every {curve.period:.3g} deg" if curve.period else ""
    scale = _scale(added, ranges)
    either = ", either side of 0" if added.bent and added.variable not in SIGNED else ""
    name = f"{added.acts_on.replace('_', ' ')} over {added.variable}{period}{either}"

    return Family(
        effect=Effect(
            name=name,
            title=name,
            place=most_probable(added.places),
            parameters=coordinates_of(curve, scale),
            apply=partial(_apply, added, curve),
        ),
        places=added.places,
        says=added.says,
        title=f"{added.title}, as a share of its change," if _is_a_share(added) else added.title,
        curve=partial(_factors if added.acts_on in FACTORS else _points, curve),
        x_unit=_x_unit(added),
        unit=_unit(added),
    )


def _scale(added: Added, ranges: LogRanges) -> float:
    """Of the coordinates of its curve."""
    if added.variable is Variable.PAST and added.of_the_drive:
        return ranges.deg_per_n_mm
    shares = added.variable in (Variable.PAST, Variable.TURNED_BY) or added.acts_on in FACTORS
    return 1.0 if shares and added.acts_on is not ActsOn.DRIVE_TORQUE else _size(added, ranges)


def _size(added: Added, ranges: LogRanges) -> float:
    """Of what is missing, in deg or N mm."""
    missing = ranges.missing[added.sensor]
    return missing * ranges.deg_per_n_mm if added.of_the_drive and added.sensor == TORQUE else missing


def _unit(added: Added) -> str:
    if added.variable is Variable.PAST and added.of_the_drive:
        return "deg / N mm"
    if _is_a_share(added) or added.acts_on in FACTORS:
        return "-"
    if added.variable in (Variable.PAST, Variable.TURNED_BY):
        return "N mm / deg"
    if added.acts_on in _SLIPS:
        return "deg/s"
    return "N mm" if added.acts_on in (ActsOn.DRIVE_TORQUE, ActsOn.TORQUE_READING) else "deg"


def _is_a_share(added: Added) -> bool:
    """Whether its curve is of shares of what it acts on, by which that lags."""
    lags = added.variable in (Variable.PAST, Variable.TURNED_BY)
    of_twist = added.variable is Variable.PAST and added.of_the_drive
    return lags and not of_twist and added.acts_on is not ActsOn.DRIVE_TORQUE


def _x_unit(added: Added) -> str:
    """Of the variable; a hysteresis is over how far what it acts on has changed since it turned back."""
    if added.variable is not Variable.TURNED_BY:
        return UNITS[added.variable]
    return "N mm" if added.acts_on is ActsOn.TORQUE_READING else "deg"


def _factors(curve: SmoothCurve, *c: float) -> Points:
    return curve.places, curve.factors(c)


def _points(curve: SmoothCurve, *c: float) -> Points:
    return curve.places, curve.values(c)


def _apply(added: Added, curve: SmoothCurve, rig: RigParameters, *c: float) -> RigParameters:
    own = curve.acting_on(added.acts_on, added.variable, c)
    return replace(rig, free=FreeLaw(curves=(own,)))
