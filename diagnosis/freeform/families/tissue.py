"""Free laws of the tissue: elastic (Kelvin-Voigt), as stiff as a curve of time, depth or place says."""

from dataclasses import replace
from functools import partial

import numpy as np

from diagnosis.effects.effect import Effect, Place
from diagnosis.freeform.families.interface import FADING, PARTS, tissue_curve
from diagnosis.freeform.family import Family, Points, coordinates_of
from diagnosis.freeform.ranges import LogRanges
from diagnosis.freeform.smooth_curve import SmoothCurve, smooth_curve
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.replay.variables import UNITS, Variable

OVER = (Variable.TIME, Variable.DEPTH, Variable.HISTORY)


def families(ranges: LogRanges) -> tuple[Family, ...]:
    """What may be missing in the tissue."""
    over = (_elastic_over(v, ranges) for v in OVER if v in ranges.ends)
    return (*over, _elastic_along_depth(ranges))


def _elastic_over(variable: Variable, ranges: LogRanges) -> Family:
    curve = smooth_curve(*ranges.ends[variable], fading=variable in FADING)
    elastic = ranges.library["tissue_viscoelasticity"]
    neutral = (0.0,) * len(elastic.parameters[0].start)

    return Family(
        effect=Effect(
            name=f"elastic tissue over {variable}",
            title=f"elastic tissue that changes with {variable}",
            place=Place.TISSUE,
            parameters=(
                *elastic.parameters,
                *(replace(p, start=neutral) for p in coordinates_of(curve)),
            ),
            apply=partial(_apply, variable, curve),
        ),
        places={Place.TISSUE: 1.0},
        says=variable,
        title="stiffness of the tissue",
        curve=partial(_stiffness, curve),
        x_unit=UNITS[variable],
        unit="N mm / rad / mm",
    )


def _elastic_along_depth(ranges: LogRanges) -> Family:
    curve, elastic = smooth_curve(0.0, 1.0, PARTS), ranges.library["tissue_viscoelasticity"]
    neutral = (0.0,) * len(elastic.parameters[0].start)
    return Family(
        effect=Effect(
            name="elastic tissue over position",
            title="elastic tissue that changes along the inserted shaft",
            place=Place.TISSUE,
            parameters=(
                *elastic.parameters,
                *(replace(p, start=neutral) for p in coordinates_of(curve)),
            ),
            apply=partial(_apply_along_depth, curve),
        ),
        places={Place.TISSUE: 1.0},
        says="position",
        title="stiffness of the tissue",
        curve=partial(_stiffness, curve),
        x_unit="of the inserted length",
        unit="N mm / rad / mm",
    )


def _apply_along_depth(
    curve: SmoothCurve, rig: RigParameters, stiffness: float, time_constant: float, *c: float
) -> RigParameters:
    return replace(
        rig,
        tissue_stiffness_n_mm_per_rad_per_mm=stiffness,
        tissue_time_constant_s=time_constant,
        free=FreeLaw(stiffness_along_depth=tuple(float(v) for v in np.exp(curve.values(c)))),
    )


def _stiffness(curve: SmoothCurve, stiffness: float, _: float, *c: float) -> Points:
    return curve.places, stiffness * np.exp(curve.values(c))


def _apply(
    variable: Variable,
    curve: SmoothCurve,
    rig: RigParameters,
    stiffness: float,
    time_constant: float,
    *c: float,
) -> RigParameters:
    return replace(
        rig,
        tissue_stiffness_n_mm_per_rad_per_mm=stiffness,
        tissue_time_constant_s=time_constant,
        free=FreeLaw(tissue_varies=True, curves=(tissue_curve(variable, curve, c),)),
    )
