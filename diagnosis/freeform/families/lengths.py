"""Free laws of the length that is in contact with tissue: what is true, less what is logged, mm.

- over the logged length: a stage with a wrong pitch, or a surface that is not where it was touched
- over the axial speed: tissue that the needle pushes in before it slides, and draws out after
"""

from dataclasses import replace
from functools import partial

from diagnosis.effects.effect import Effect, Place
from diagnosis.freeform.family import Family, Points, coordinates_of
from diagnosis.freeform.ranges import LogRanges
from diagnosis.freeform.smooth_curve import SmoothCurve, bent_curve, smooth_curve
from diagnosis.replay.curve import ActsOn
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.replay.variables import UNITS, Variable

_COUNT, _SIZE_MM = 6, 8.0
_PLACES = {
    Variable.DEPTH: {Place.PARAMETERS: 1.0},
    Variable.AXIAL_SPEED: {Place.TISSUE: 0.6, Place.PARAMETERS: 0.4},
}


def families(ranges: LogRanges) -> tuple[Family, ...]:
    """Both laws, if length and speed change."""
    return tuple(_length_over(v, ranges) for v in _PLACES if v in ranges.ends)


def _length_over(variable: Variable, ranges: LogRanges) -> Family:
    curve_over = smooth_curve if variable is Variable.DEPTH else bent_curve
    curve = curve_over(*ranges.ends[variable], _COUNT)
    places = _PLACES[variable]
    return Family(
        effect=Effect(
            name=f"inserted length over {variable}",
            title=f"an inserted length whose error changes with {variable}",
            place=max(places, key=lambda place: places[place]),
            parameters=coordinates_of(curve, _SIZE_MM),
            apply=partial(_apply, variable, curve),
            differences=(1e-2,),
        ),
        places=places,
        says=variable,
        title="error of the inserted length",
        curve=partial(_points, curve),
        x_unit=UNITS[variable],
        unit="mm",
    )


def _points(curve: SmoothCurve, *c: float) -> Points:
    return curve.places, curve.values(c)


def _apply(variable: Variable, curve: SmoothCurve, rig: RigParameters, *c: float) -> RigParameters:
    own = curve.acting_on(ActsOn.INSERTED_LENGTH, variable, c)
    return replace(rig, free=FreeLaw(curves=(own,)))
