"""Free laws of dry friction between torque sensor and chuck, which the sensor reads and the needle does
not feel: a level times the direction in which the drive slides, where the level is a curve

    of the angle of the drive shaft, once a turn, as of a shaft that binds in a part of its turn,
    of the inserted length, as of a shaft that is guided over less and less of its length,
    of the axial speed, as of a bearing that a carriage loads, or of the time.
"""

from dataclasses import replace
from functools import partial

from diagnosis.effects.effect import Effect, Place
from diagnosis.freeform.families.interface import TURN_DEG, curve_over
from diagnosis.freeform.family import Family, Points, coordinates_of
from diagnosis.freeform.ranges import LogRanges
from diagnosis.freeform.smooth_curve import SmoothCurve, periodic_curve
from diagnosis.log.trial import TORQUE
from diagnosis.replay.curve import ActsOn, Course, Curve
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.replay.variables import UNITS, Variable

OVER = (Variable.DEPTH, Variable.AXIAL_SPEED, Variable.TIME)
_IN_A_TURN = 18  # places: a shaft may bind in a small part of its turn


def families(ranges: LogRanges) -> tuple[Family, ...]:
    """The laws, if the torque was read and the drive slides."""
    if TORQUE not in ranges.missing or Variable.SLID_DIRECTION not in ranges.ends:
        return ()
    curves = {v: curve_over(v, ranges) for v in OVER if v in ranges.ends}
    curves[Variable.BASE_ANGLE] = periodic_curve(TURN_DEG, _IN_A_TURN)
    return tuple(_over(v, curve, ranges) for v, curve in curves.items())


def _over(variable: Variable, curve: SmoothCurve, ranges: LogRanges) -> Family:
    once_a_turn = f", every {curve.period:.3g} deg" if curve.period else ""
    return Family(
        effect=Effect(
            name=f"bearing friction over {variable}{once_a_turn}",
            title=f"dry friction in the drive that changes with {variable}",
            place=Place.DRIVE,
            parameters=coordinates_of(curve, ranges.missing[TORQUE]),
            apply=partial(_apply, variable, curve),
        ),
        places={Place.DRIVE: 0.8, Place.SENSOR: 0.2},
        says=variable,
        title="dry friction in the drive, which the needle does not feel",
        curve=partial(_levels, curve),
        x_unit=UNITS[variable],
        unit="N mm",
    )


def _levels(curve: SmoothCurve, *c: float) -> Points:
    return curve.places, curve.values(c)


def _apply(variable: Variable, curve: SmoothCurve, rig: RigParameters, *c: float) -> RigParameters:
    level = Course(
        variable=variable,
        places=tuple(float(place) for place in curve.places),
        values=curve.values(c),
        period=curve.period,
    )
    against = Curve(
        acts_on=ActsOn.DRIVE_TORQUE,
        variable=Variable.SLID_DIRECTION,
        places=(-1.0, 1.0),
        values=(-1.0, 1.0),
        factor=level,
    )
    return replace(rig, free=FreeLaw(curves=(against,)))
