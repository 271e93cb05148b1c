"""Free laws of tissue that is another from a depth below the surface on.

- damping
- dry friction in addition

Layers of one thickness blur where it begins; here the depth is fitted.
"""

from dataclasses import replace
from functools import partial

from diagnosis.effects.effect import Effect, Place
from diagnosis.freeform.families.in_layers.layers import factor_of_damping, place_of
from diagnosis.freeform.family import VISCOUS, Family, Points
from diagnosis.freeform.ranges import LogRanges
from diagnosis.replay.along_depth import AlongDepth
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.replay.variables import Variable

_FROM = (0.05, 0.15, 0.25, 0.35, 0.45, 0.55, 0.65, 0.75, 0.85)
"""Of the greatest depth, where it is looked for."""
_TIMES = (2.0, 0.5)  # the damping above it
_STEP_MM = 1e-3  # from one side to the other as it is drawn
_DIFFERENCES = (1e-1, 1e-2)


def families(ranges: LogRanges) -> tuple[Family, ...]:
    """Both laws; at one inserted length another damping is an effect of the library (two layers)."""
    deepest = ranges.deepest_mm
    friction = _friction(deepest, ranges)
    return (friction, _damping(deepest, ranges)) if Variable.DEPTH in ranges.ends else (friction,)


def _damping(deepest_mm: float, ranges: LogRanges) -> Family:
    times = factor_of_damping(tuple(times for times in _TIMES for _ in _FROM))
    return Family(
        effect=Effect(
            name="damping over position, from a depth on",
            title="tissue whose damping is another from a depth on",
            place=Place.TISSUE,
            parameters=(place_of("depth", deepest_mm, len(_TIMES) * _FROM), times),
            apply=_apply_damping,
            differences=_DIFFERENCES,
        ),
        places={Place.TISSUE: 0.6, Place.INTERFACE: 0.4},
        says="position",
        title="damping along the shaft",
        curve=partial(_dampings, deepest_mm, ranges.damping_n_mm_s_per_mm),
        x_unit="mm below the surface",
        unit=VISCOUS,
    )


def _friction(deepest_mm: float, ranges: LogRanges) -> Family:
    level = ranges.dry_level
    return Family(
        effect=Effect(
            name="dry friction over position, from a depth on",
            title="dry friction of tissue from a depth on",
            place=Place.INTERFACE,
            parameters=(
                place_of("depth", deepest_mm, _FROM),
                replace(level, start=tuple(level.start[-1] / (1.0 - share) for share in _FROM)),
            ),
            apply=_apply_friction,
            differences=_DIFFERENCES,
        ),
        places={Place.INTERFACE: 0.6, Place.TISSUE: 0.4},
        says="position",
        title="dry friction along the shaft",
        curve=partial(_step, deepest_mm, 0.0),
        x_unit="mm below the surface",
        unit="N mm / mm",
    )


def _dampings(deepest_mm: float, beta: float, depth: float, times: float) -> Points:
    return _step(deepest_mm, beta, depth, beta * times)


def _step(deepest_mm: float, above: float, depth: float, below: float) -> Points:
    end = max(deepest_mm, depth + 2.0 * _STEP_MM)
    return (0.0, depth, depth + _STEP_MM, end), (above, above, below, below)


def _apply_damping(rig: RigParameters, depth: float, times: float) -> RigParameters:
    return _with(rig, AlongDepth(damping=(1.0, times), thicknesses_mm=(depth,)))


def _apply_friction(rig: RigParameters, depth: float, level: float) -> RigParameters:
    return _with(rig, AlongDepth(friction_n_mm_per_mm=(0.0, level), thicknesses_mm=(depth,)))


def _with(rig: RigParameters, along: AlongDepth) -> RigParameters:
    return replace(rig, free=FreeLaw(along_depth=along))
