"""A curve that is added to an angle or a reading: its numbers, its units and the family that they make.

    angle = that of the nominal rig + curve(variable)
    reading = true value + curve(variable), or true value times a curve

A curve of what came before is of shares: of the change of what it is added to, by which that lags. The
drive turns its needle by more or less than the encoder says where the curve is the drive's; its size is
that of what the tip's reading misses, or the twist under the torque that is missing.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from diagnosis.effects.effect import Effect, Place
from diagnosis.freeform.family import Family, Points, coordinates_of, most_probable
from diagnosis.freeform.ranges import LogRanges
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
from diagnosis.freeform.templates.ripple import waves_in_a_turn
from diagnosis.log.trial import TORQUE
from diagnosis.replay.curve import FACTORS, ActsOn
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.replay.variables import UNITS, Variable

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


@dataclass(frozen=True, kw_only=True)
class AddedCurve:
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


def curve_of(added: AddedCurve, ranges: LogRanges) -> SmoothCurve:
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


def _over_the_range(added: AddedCurve, ranges: LogRanges) -> SmoothCurve:
    low, high = ranges.ends[added.variable]
    if added.variable is Variable.PAST:
        return separate_values(np.geomspace(low, high, PAST_PLACES))
    if added.variable is Variable.AXIAL_SPEED:
        return jumping_curve(low, high, PLACES)
    if added.bent:
        curve = ranges.in_detail(bent_curve(low, high, PLACES, close=added.variable in _RATES))
        return curve.zero_at_zero() if added.acts_on in _SLIPS else curve  # nothing slips at rest
    return ranges.in_detail(smooth_curve(low, high, PLACES))


def _hysteresis(added: AddedCurve, ranges: LogRanges) -> SmoothCurve:
    """Shares of what turns, or of the friction that turning back and forth builds up in the drive."""
    if added.acts_on is ActsOn.DRIVE_TORQUE:
        return SmoothCurve(places=DRAGGED_DEG, basis=np.diag(1.0 / DRAGGED_DEG), straight=0)
    return separate_values(_size(added, ranges) * TURNED_BY)


def family_of(added: AddedCurve, curve: SmoothCurve, ranges: LogRanges) -> Family:
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


def _scale(added: AddedCurve, ranges: LogRanges) -> float:
    """Of the coordinates of its curve."""
    if added.variable is Variable.PAST and added.of_the_drive:
        return ranges.deg_per_n_mm
    shares = added.variable in (Variable.PAST, Variable.TURNED_BY) or added.acts_on in FACTORS
    return 1.0 if shares and added.acts_on is not ActsOn.DRIVE_TORQUE else _size(added, ranges)


def _size(added: AddedCurve, ranges: LogRanges) -> float:
    """Of what is missing, in deg or N mm."""
    missing = ranges.missing[added.sensor]
    return missing * ranges.deg_per_n_mm if added.of_the_drive and added.sensor == TORQUE else missing


def _unit(added: AddedCurve) -> str:
    if added.variable is Variable.PAST and added.of_the_drive:
        return "deg / N mm"
    if _is_a_share(added) or added.acts_on in FACTORS:
        return "-"
    if added.variable in (Variable.PAST, Variable.TURNED_BY):
        return "N mm / deg"
    if added.acts_on in _SLIPS:
        return "deg/s"
    return "N mm" if added.acts_on in (ActsOn.DRIVE_TORQUE, ActsOn.TORQUE_READING) else "deg"


def _is_a_share(added: AddedCurve) -> bool:
    """Whether its curve is of shares of what it acts on, by which that lags."""
    lags = added.variable in (Variable.PAST, Variable.TURNED_BY)
    of_twist = added.variable is Variable.PAST and added.of_the_drive
    return lags and not of_twist and added.acts_on is not ActsOn.DRIVE_TORQUE


def _x_unit(added: AddedCurve) -> str:
    """Of the variable; a hysteresis is over how far what it acts on has changed since it turned back."""
    if added.variable is not Variable.TURNED_BY:
        return UNITS[added.variable]
    return "N mm" if added.acts_on is ActsOn.TORQUE_READING else "deg"


def _factors(curve: SmoothCurve, *c: float) -> Points:
    return curve.places, curve.factors(c)


def _points(curve: SmoothCurve, *c: float) -> Points:
    return curve.places, curve.values(c)


def _apply(added: AddedCurve, curve: SmoothCurve, rig: RigParameters, *c: float) -> RigParameters:
    own = curve.acting_on(added.acts_on, added.variable, c)
    return replace(rig, free=FreeLaw(curves=(own,)))
