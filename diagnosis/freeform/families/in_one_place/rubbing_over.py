"""Free laws of drag and dry friction where the shaft enters, or in its sheath, times a curve.

Of the time, as of a seal that dries; of the axial speed, as of a shaft that bows where it is pushed; of
the inserted length, or, once a turn, of the angle of the drive shaft, as of one that is bent.
"""

from dataclasses import replace
from functools import partial

from diagnosis.effects.effect import Effect
from diagnosis.freeform.families.in_one_place.rubbing import SPOTS, Spot
from diagnosis.freeform.families.in_one_place.tip import torques
from diagnosis.freeform.families.interface import SLOW_RAD_S, TURN_DEG, WAVES, curve_over
from diagnosis.freeform.family import Family, coordinates_of, most_probable
from diagnosis.freeform.ranges import LogRanges
from diagnosis.freeform.smooth_curve import SmoothCurve, periodic_curve
from diagnosis.replay.curve import ActsOn
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.replay.variables import UNITS, Variable
from models.tissue import Interface

OVER = (Variable.TIME, Variable.AXIAL_SPEED, Variable.DEPTH)


def families(ranges: LogRanges) -> tuple[Family, ...]:
    """Laws of each spot over each variable."""
    curves = {v: curve_over(v, ranges) for v in OVER if v in ranges.ends}
    if Variable.BASE_ANGLE in ranges.ends:
        curves[Variable.BASE_ANGLE] = periodic_curve(TURN_DEG, WAVES)
    return tuple(_over(s, v, curve, ranges) for s in SPOTS for v, curve in curves.items())


def _over(spot: Spot, variable: Variable, curve: SmoothCurve, ranges: LogRanges) -> Family:
    dry = spot.dry(ranges)
    own = (replace(p, start=p.start * len(dry.start)) for p in coordinates_of(curve))
    return Family(
        effect=Effect(
            name=f"{spot.name} over {variable}",
            title=f"drag and dry friction {spot.words} that change with {variable}",
            place=most_probable(spot.places),
            parameters=(spot.drag(ranges), dry, *own),
            apply=partial(_apply, spot, variable, curve),
            differences=(1e-2,),
        ),
        places=spot.places,
        says=variable,
        title=f"torque {spot.words} at {SLOW_RAD_S:g} rad/s",
        curve=partial(torques, curve),
        x_unit=UNITS[variable],
        unit=spot.unit,
    )


def _apply(
    spot: Spot,
    variable: Variable,
    curve: SmoothCurve,
    rig: RigParameters,
    damping: float,
    level: float,
    *c: float,
) -> RigParameters:
    law = Interface(viscous_n_mm_s_per_mm=damping, kinetic_n_mm_per_mm=level, varies=True)
    changing = curve.acting_on(ActsOn.TISSUE, variable, c)
    return replace(rig, free=replace(spot.with_laws(law), curves=(changing,)))
