"""A spring between the tissue and each piece of the shaft, beside friction: it gives, and never slips.

    torque per mm += k g(x) (angle - angle at the start of the trial)

with a smooth curve of factors g over time, depth or what was turned so far: tissue that has grown to
the needle and softens, glue that sets. It is a wave over the angle that is slow enough to be straight,
to 1 % where the base turns farthest.
"""

import math
from dataclasses import replace
from functools import partial

import numpy as np

from diagnosis.effects.effect import Effect, Place
from diagnosis.freeform.families.interface import FADING
from diagnosis.freeform.family import Family, Points, coordinates_of, from_neutral
from diagnosis.freeform.ranges import LogRanges
from diagnosis.freeform.smooth_curve import SmoothCurve, smooth_curve
from diagnosis.replay.curve import ActsOn
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.replay.variables import SAYS, UNITS, Variable
from models.tissue import Interface

OVER = (Variable.TIME, Variable.DEPTH, Variable.HISTORY)
_STRAIGHT_RAD = 0.25  # of the wave: its sine is 1 % less


def families(ranges: LogRanges) -> tuple[Family, ...]:
    """One for each variable, where the base turns."""
    if Variable.BASE_ANGLE not in ranges.ends:
        return ()
    return tuple(_spring_over(variable, ranges) for variable in OVER if variable in ranges.ends)


def _spring_over(variable: Variable, ranges: LogRanges) -> Family:
    curve = smooth_curve(*ranges.ends[variable], fading=variable in FADING)
    stiffness, _ = ranges.library["tissue_viscoelasticity"].parameters
    low_deg, high_deg = ranges.ends[Variable.BASE_ANGLE]
    cycles = _STRAIGHT_RAD / math.radians(high_deg - low_deg)
    return Family(
        effect=Effect(
            name=f"spring to the tissue over {variable}",
            title=f"a spring between shaft and tissue that changes with {variable}",
            place=Place.TISSUE,
            parameters=(
                replace(stiffness, low=1e-3 * stiffness.low, neutral=0.0),
                *from_neutral(coordinates_of(curve), stiffness),
            ),
            apply=partial(_apply, variable, curve, cycles),
        ),
        places={Place.TISSUE: 0.6, Place.INTERFACE: 0.4},
        says=SAYS.get(variable, variable),
        title="stiffness of the spring to the tissue",
        curve=partial(_stiffness, curve),
        x_unit=UNITS[variable],
        unit="N mm / rad / mm",
    )


def _stiffness(curve: SmoothCurve, stiffness: float, *c: float) -> Points:
    return curve.places, stiffness * np.array(curve.factors(c))


def _apply(
    variable: Variable,
    curve: SmoothCurve,
    cycles: float,
    rig: RigParameters,
    stiffness: float,
    *c: float,
) -> RigParameters:
    wave = Interface(orientation_n_mm_per_mm=stiffness / cycles, orientation_cycles=cycles, varies=True)
    changes = curve.acting_on(ActsOn.TISSUE, variable, c)
    return replace(rig, free=FreeLaw(from_start=(wave,), curves=(changes,)))
