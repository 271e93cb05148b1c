"""Free laws of an interface that depends on the angle of each piece of shaft, which is not round.

    damping       = beta + sum over n of (a_n sin(n angle) + b_n cos(n angle))
    dry friction  = level + the same sum + the sizes of its waves: never less than level

The waves of the damping are held below it, so that the interface only takes energy.
"""

import math
from collections.abc import Sequence
from dataclasses import replace
from functools import partial

import numpy as np
from numpy.typing import NDArray

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.freeform.families.angle import ALONG, over_angles, shown_deg
from diagnosis.freeform.family import VISCOUS, Family, Points, coordinates
from diagnosis.freeform.ranges import LogRanges
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.replay.variables import Variable
from models.tissue import Interface

Array = NDArray[np.float64]

_MOST_UNEVEN = 0.95  # of the damping, that it changes over a turn


def families(ranges: LogRanges) -> tuple[Family, ...]:
    """Damping and dry friction over the angle of the shaft; none if it hardly turns."""
    if Variable.BASE_ANGLE not in ranges.ends:
        return ()
    return _uneven_damping(ranges), _uneven_friction(ranges)


def _uneven_damping(ranges: LogRanges) -> Family:
    """Damping of each piece of the shaft over its own angle."""
    beta = ranges.damping_n_mm_s_per_mm
    return Family(
        effect=Effect(
            name="damping along the shaft over tip_angle",
            title="damping that depends on the angle of the shaft",
            place=Place.INTERFACE,
            parameters=coordinates(2 * len(ALONG), 0, beta),
            apply=partial(_apply_uneven, beta),
        ),
        places={Place.INTERFACE: 0.6, Place.NEEDLE: 0.4},
        says="tip_angle",
        title="damping along the shaft",
        curve=partial(_damping_over_angles, shown_deg(ranges), beta),
        x_unit="deg",
        unit=VISCOUS,
    )


def _damping_over_angles(shown: Array, beta: float, *c: float) -> Points:
    angle, waves = over_angles(shown, ALONG, *_kept_below(beta, c))
    return angle, beta + np.asarray(waves)


def _apply_uneven(beta: float, rig: RigParameters, *c: float) -> RigParameters:
    kept = _kept_below(beta, c)
    waves = zip(ALONG, kept[::2], kept[1::2], strict=True)
    return replace(rig, free=FreeLaw(throughout=tuple(damping_wave(*own) for own in waves)))


def damping_wave(cycles: int, sine: float, cosine: float) -> Interface:
    """One wave: a sin x + b cos x = hypot(a, b) cos(x - atan2(a, b))."""
    return Interface(
        orientation_viscous_n_mm_s_per_mm=math.hypot(sine, cosine),
        orientation_phase_deg=math.degrees(math.atan2(sine, cosine)),
        orientation_cycles=float(cycles),
    )


def _kept_below(beta: float, c: Sequence[float]) -> list[float]:
    """Waves that leave some damping at any angle."""
    most = sum_of_sizes(c)
    share = min(1.0, _MOST_UNEVEN * beta / most) if most > 0.0 else 1.0
    return [share * own for own in c]


def _uneven_friction(ranges: LogRanges) -> Family:
    """Dry friction of each piece of shaft over its own angle: never less than at its easiest angle."""
    return Family(
        effect=Effect(
            name="dry friction along the shaft over tip_angle",
            title="dry friction that depends on the angle of the shaft",
            place=Place.INTERFACE,
            parameters=level_and_waves(ranges.dry_level),
            apply=_apply_uneven_friction,
            differences=(1e-2,),
        ),
        places={Place.INTERFACE: 0.6, Place.NEEDLE: 0.4},
        says="tip_angle",
        title="dry friction along the shaft",
        curve=partial(size_over_angles, shown_deg(ranges), ALONG),
        x_unit="deg",
        unit="N mm / mm",
    )


def level_and_waves(level: Parameter, waves: int = len(ALONG)) -> tuple[Parameter, ...]:
    """A level and waves upon it, with starts in four directions: at no wave, its size has no slope."""
    towards = [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)]
    starts = [(size, size * sine, size * cosine) for size in level.start for sine, cosine in towards]
    levels, sines, cosines = zip(*starts, strict=True)
    sine, cosine, *others = coordinates(2 * waves, 0, level.start[-1])
    return (
        replace(level, start=levels),
        replace(sine, start=sines),
        replace(cosine, start=cosines),
        *(replace(p, start=(0.0,) * len(starts)) for p in others),
    )


def size_over_angles(shown: Array, waves: Sequence[int], level: float, *c: float) -> Points:
    """A level, and upon it waves with these cycles in a turn, over angles, deg."""
    angle, above = over_angles(shown, waves, *c)
    return angle, level + sum_of_sizes(c) + np.asarray(above)


def sum_of_sizes(c: Sequence[float]) -> float:
    """Sizes of all waves, from sine and cosine of each."""
    return sum(math.hypot(a, b) for a, b in zip(c[::2], c[1::2], strict=True))


def _apply_uneven_friction(rig: RigParameters, level: float, *c: float) -> RigParameters:
    waves = zip(ALONG, c[::2], c[1::2], strict=True)
    first, *others = (friction_wave(*own) for own in waves)
    return replace(rig, free=FreeLaw(throughout=(first.but(kinetic_n_mm_per_mm=level), *others)))


def friction_wave(cycles: int, sine: float, cosine: float) -> Interface:
    """One wave and its size: a sin x + b cos x + hypot(a, b), which is nowhere below 0."""
    return Interface(
        orientation_dry_n_mm_per_mm=math.hypot(sine, cosine),
        orientation_phase_deg=math.degrees(math.atan2(sine, cosine)),
        orientation_cycles=float(cycles),
    )
