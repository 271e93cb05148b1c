"""Free laws of the length that is in contact with tissue: what is true, less what is logged, mm.

- over the logged length: a stage with a wrong pitch, or a surface that is not where it was touched
- over the axial speed: tissue that the needle pushes in before it slides, and draws out after
- with hysteresis over the logged length: a surface that goes with the shaft until it slides, up to one
  limit, or to several
- of the length before the tissue, over itself: a chuck that holds the shaft elsewhere, or a wrong scale
"""

from dataclasses import replace
from functools import partial

import numpy as np

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.freeform.family import Family, Points, coordinates_of, most_probable
from diagnosis.freeform.ranges import LEAST_RANGE, LogRanges
from diagnosis.freeform.smooth_curve import SmoothCurve, bent_curve, separate_values, smooth_curve
from diagnosis.replay.curve import ActsOn, Curve
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.replay.variables import SAYS, UNITS, Variable

_COUNT, _SIZE_MM, _SHARE, _MOST = 6, 8.0, 0.3, 0.8
_MOST_FREE_MM, _MOST_FREE, _USUAL_FREE = 100.0, 0.5, 0.1  # error of the free length, and of its scale
_PLACES = {
    Variable.DEPTH: {Place.PARAMETERS: 1.0},
    Variable.AXIAL_SPEED: {Place.TISSUE: 0.6, Place.PARAMETERS: 0.4},
}


def families(ranges: LogRanges) -> tuple[Family, ...]:
    """Those of the inserted length if length and speed change; that of the free length always."""
    found = [_length_over(v, ranges) for v in _PLACES if v in ranges.ends]
    if Variable.ADVANCED_BY in ranges.ends:
        found += [_dragged(ranges), _dragged_to_one_limit(ranges)]
    return (*found, _free_length(ranges))


def _free_length(ranges: LogRanges) -> Family:
    """An error of the length before the tissue, and one of its scale where it changes."""
    mean_mm = float(np.mean([trial.schedule.free_mm.mean() for trial in ranges.problem.log.trials]))
    ends = ranges.ends.get(Variable.FREE, (mean_mm - 1.0, mean_mm + 1.0))
    error = Parameter(
        name="error", unit="mm", low=-_MOST_FREE_MM, high=_MOST_FREE_MM, start=(0.0,), scale=_SIZE_MM
    )
    scale = Parameter(
        name="scale", unit="-", low=-_MOST_FREE, high=_MOST_FREE, start=(0.0,), scale=_USUAL_FREE
    )
    return Family(
        effect=Effect(
            name="free length over free",
            title="a free length that is not the logged one",
            place=Place.PARAMETERS,
            parameters=(error, scale) if Variable.FREE in ranges.ends else (error,),
            apply=partial(_apply_free, ends),
            differences=(1e-2,),
        ),
        places={Place.PARAMETERS: 1.0},
        says=SAYS[Variable.FREE],
        title="error of the free length",
        curve=partial(_over_free, ends),
        x_unit=UNITS[Variable.FREE],
        unit="mm",
    )


def _over_free(
    ends: tuple[float, float], error_mm: float, scale: float = 0.0
) -> tuple[tuple[float, float], tuple[float, float]]:
    """The error is that of the middle of the range."""
    low, high = ends
    swing = 0.5 * scale * (high - low)
    return ends, (error_mm - swing, error_mm + swing)


def _apply_free(ends: tuple[float, float], rig: RigParameters, *values: float) -> RigParameters:
    places, errors = _over_free(ends, *values)
    own = Curve(
        acts_on=ActsOn.FREE_LENGTH,
        variable=Variable.FREE,
        places=places,
        values=errors,
    )
    return replace(rig, free=FreeLaw(curves=(own,)))


def _length_over(variable: Variable, ranges: LogRanges) -> Family:
    curve_over = smooth_curve if variable is Variable.DEPTH else bent_curve
    curve = curve_over(*ranges.ends[variable], _COUNT)
    places = _PLACES[variable]
    return Family(
        effect=Effect(
            name=f"inserted length over {variable}",
            title=f"an inserted length whose error changes with {variable}",
            place=most_probable(places),
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
            place=most_probable(places),
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


def _dragged_to_one_limit(ranges: LogRanges) -> Family:
    least_mm, longest_mm = LEAST_RANGE[Variable.ADVANCED_BY] / 4, ranges.ends[Variable.ADVANCED_BY][1]
    starts = tuple(least_mm * (longest_mm / least_mm) ** share for share in (0.3, 0.6, 0.9))
    several = _dragged(ranges)
    parameters = (
        Parameter(
            name="share", unit="-", low=-1.5, high=1.5, start=(-_MOST,) * len(starts), scale=_SHARE
        ),
        Parameter(
            name="limit",
            unit="mm",
            low=least_mm,
            high=longest_mm,
            start=starts,
            logarithmic=True,
            neutral=None,
        ),
    )
    effect = replace(
        several.effect,
        name=f"{several.name}, up to one limit",
        parameters=parameters,
        apply=_apply_one_limit,
        differences=(1e-1, 1e-2),
    )
    return replace(several, effect=effect, curve=_after_an_advance_to_one)


def _after_an_advance_to_one(share: float, limit_mm: float) -> Points:
    return (0.0, limit_mm, 2.0 * limit_mm), (0.0, share * limit_mm, share * limit_mm)


def _apply_one_limit(rig: RigParameters, share: float, limit_mm: float) -> RigParameters:
    limits = separate_values(np.array([limit_mm, 2.0 * limit_mm]))
    return _apply(Variable.ADVANCED_BY, limits, rig, share, 0.0)


def _after_an_advance(limits: SmoothCurve, *c: float) -> Points:
    """From rest on: the sum of shares of the advance, each up to its limit."""
    advance = np.array([0.0, *limits.places])
    return advance, np.minimum(advance[:, None], limits.places) @ np.array(limits.values(c))


def _points(curve: SmoothCurve, *c: float) -> Points:
    return curve.places, curve.values(c)


def _apply(variable: Variable, curve: SmoothCurve, rig: RigParameters, *c: float) -> RigParameters:
    own = curve.acting_on(ActsOn.INSERTED_LENGTH, variable, c)
    return replace(rig, free=FreeLaw(curves=(own,)))
