"""Free laws of the length that is in contact with tissue: what is true, less what is logged, mm.

- over the logged length: a stage with a wrong pitch, or a surface that is not where it was touched
- over the axial speed: tissue that the needle pushes in before it slides, and draws out after
- with hysteresis over the logged length: a surface that goes with the shaft until it slides
"""

from dataclasses import replace
from functools import partial

import numpy as np

from diagnosis.effects.effect import Effect, Place
from diagnosis.freeform.family import Family, Points, coordinates_of
from diagnosis.freeform.ranges import LEAST_RANGE, LogRanges
from diagnosis.freeform.smooth_curve import SmoothCurve, bent_curve, separate_values, smooth_curve
from diagnosis.replay.curve import ActsOn
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.replay.variables import SAYS, UNITS, Variable

_COUNT, _SIZE_MM, _SHARE = 6, 8.0, 0.3
_PLACES = {
    Variable.DEPTH: {Place.PARAMETERS: 1.0},
    Variable.AXIAL_SPEED: {Place.TISSUE: 0.6, Place.PARAMETERS: 0.4},
}


def families(ranges: LogRanges) -> tuple[Family, ...]:
    """All laws, if length and speed change."""
    found = [_length_over(v, ranges) for v in _PLACES if v in ranges.ends]
    dragged = [_dragged(ranges)] if Variable.ADVANCED_BY in ranges.ends else []
    return (*found, *dragged)


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


def _dragged(ranges: LogRanges) -> Family:
    """Shares of an advance by which the surface goes along, each up to a limit of its own."""
    longest_mm = ranges.ends[Variable.ADVANCED_BY][1]
    limits = separate_values(np.geomspace(LEAST_RANGE[Variable.ADVANCED_BY] / 4, longest_mm, _COUNT))
    places = _PLACES[Variable.AXIAL_SPEED]
    return Family(
        effect=Effect(
            name=f"inserted length over {Variable.ADVANCED_BY}",
            title="an inserted length whose error has hysteresis over the advance",
            place=max(places, key=lambda place: places[place]),
            parameters=coordinates_of(limits, _SHARE),
            apply=partial(_apply, Variable.ADVANCED_BY, limits),
            differences=(1e-2,),
        ),
        places=places,
        says=SAYS[Variable.ADVANCED_BY],
        title="error of the inserted length after the needle has moved the other way",
        curve=partial(_after_an_advance, limits),
        x_unit=UNITS[Variable.ADVANCED_BY],
        unit="mm",
    )


def _after_an_advance(limits: SmoothCurve, *c: float) -> Points:
    """From rest on: the sum of shares of the advance, each up to its limit."""
    advance = np.array([0.0, *limits.places])
    return advance, np.minimum(advance[:, None], limits.places) @ np.array(limits.values(c))


def _points(curve: SmoothCurve, *c: float) -> Points:
    return curve.places, curve.values(c)


def _apply(variable: Variable, curve: SmoothCurve, rig: RigParameters, *c: float) -> RigParameters:
    own = curve.acting_on(ActsOn.INSERTED_LENGTH, variable, c)
    return replace(rig, free=FreeLaw(curves=(own,)))
