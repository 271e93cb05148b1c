"""Free laws of a torque that turns the tip, whether it turns or rests, as a curve.

Of the axial speed, as of a bevel that screws itself in; of the inserted length, or of the time.
"""

from dataclasses import replace
from functools import partial

from diagnosis.effects.effect import Effect, Place
from diagnosis.freeform.families.interface import curve_over
from diagnosis.freeform.family import Family, Points, coordinates_of
from diagnosis.freeform.ranges import LogRanges
from diagnosis.freeform.smooth_curve import SmoothCurve
from diagnosis.log.trial import TIP, TORQUE
from diagnosis.replay.curve import ActsOn
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.replay.variables import UNITS, Variable

OVER = (Variable.TIME, Variable.AXIAL_SPEED, Variable.DEPTH)


def families(ranges: LogRanges) -> tuple[Family, ...]:
    """Laws over each variable that varies."""
    return tuple(_turning(v, curve_over(v, ranges), ranges) for v in OVER if v in ranges.ends)


def _turning(variable: Variable, curve: SmoothCurve, ranges: LogRanges) -> Family:
    return Family(
        effect=Effect(
            name=f"torque that turns the tip over {variable}",
            title=f"a torque that turns the tip and changes with {variable}",
            place=Place.NEEDLE,
            parameters=coordinates_of(curve, _missing_n_mm(ranges)),
            apply=partial(_apply_turning, variable, curve),
        ),
        places={Place.NEEDLE: 0.8, Place.TISSUE: 0.2},
        says=variable,
        title="torque that turns the tip",
        curve=partial(_values, curve),
        x_unit=UNITS[variable],
        unit="N mm",
    )


def _missing_n_mm(ranges: LogRanges) -> float:
    """A torque at the tip that changes readings by about as much as is missing."""
    each = {TORQUE: 1.0, TIP: 1.0 / ranges.deg_per_n_mm}
    return max(ranges.missing[sensor] * per for sensor, per in each.items() if sensor in ranges.missing)


def _values(curve: SmoothCurve, *c: float) -> Points:
    return curve.places, curve.values(c)


def _apply_turning(
    variable: Variable, curve: SmoothCurve, rig: RigParameters, *c: float
) -> RigParameters:
    return replace(rig, free=FreeLaw(curves=(curve.acting_on(ActsOn.TIP_TORQUE, variable, c),)))
