"""A free law of a joint between encoder and needle that turns unevenly, as universal joints do.

    angle of the needle at the chuck = angle that is read + e(angle)
    torque that is read = torque of the needle (1 + de / d angle)

with e = sum over n = 1, 2 of a_n sin(n angle) + b_n (cos(n angle) - 1): what passes the joint loses no
power. Beside a large torque its second line shows more than its first.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from diagnosis.effects.effect import Effect, Place
from diagnosis.freeform.families.interface import TURN_DEG
from diagnosis.freeform.family import Family, Points, coordinates
from diagnosis.freeform.ranges import LogRanges
from diagnosis.log.trial import TIP, TORQUE
from diagnosis.replay.curve import ActsOn, Curve
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.replay.variables import UNITS, Variable

_WAVES = (1, 2)
_EVERY_DEG = 10.0  # places of the curves: a spline through 18 in a wave is off by 1e-4 of it
_AT_DEG = np.arange(0.0, TURN_DEG, _EVERY_DEG)
_LEAST = 0.05  # of the ratio of rates


def families(ranges: LogRanges) -> tuple[Family, ...]:
    """The law, if the torque was read and the base turns."""
    if TORQUE not in ranges.missing or Variable.BASE_ANGLE not in ranges.ends:
        return ()
    scale = ranges.missing.get(TIP, ranges.missing[TORQUE] * ranges.deg_per_n_mm)
    effect = Effect(
        name="drive angle over base_angle, through a joint",
        title="a joint between encoder and needle that turns unevenly",
        place=Place.DRIVE,
        parameters=coordinates(2 * len(_WAVES), 0, scale),
        apply=_apply,
    )
    return (
        Family(
            effect=effect,
            places={Place.DRIVE: 1.0},
            says=Variable.BASE_ANGLE,
            title="error of the drive's angle, through a joint",
            curve=_shown,
            x_unit=UNITS[Variable.BASE_ANGLE],
            unit="deg",
        ),
    )


def _shown(*c: float) -> Points:
    return _AT_DEG, _errors_deg(c)


def _errors_deg(c: Sequence[float]) -> np.ndarray:
    """By how far the needle is ahead of the encoder at the places of an angle, deg."""
    angle = np.radians(_AT_DEG)
    return sum(
        (a * np.sin(n * angle) + b * (np.cos(n * angle) - 1.0) for n, a, b in _by_wave(c)),
        start=np.zeros(angle.size),
    )


def _ratios(c: Sequence[float]) -> np.ndarray:
    """Rates of the needle over those of the encoder there."""
    angle = np.radians(_AT_DEG)
    slopes = (n * np.radians(a * np.cos(n * angle) - b * np.sin(n * angle)) for n, a, b in _by_wave(c))
    return np.maximum(1.0 + sum(slopes, start=np.zeros(angle.size)), _LEAST)


def _by_wave(c: Sequence[float]) -> list[tuple[int, float, float]]:
    return [(n, c[2 * i], c[2 * i + 1]) for i, n in enumerate(_WAVES)]


def _apply(rig: RigParameters, *c: float) -> RigParameters:
    curves = {ActsOn.DRIVE_ANGLE: _errors_deg(c), ActsOn.TORQUE_GAIN: _ratios(c)}
    return replace(
        rig,
        free=FreeLaw(
            curves=tuple(
                Curve(
                    acts_on=acts_on,
                    variable=Variable.BASE_ANGLE,
                    places=tuple(_AT_DEG),
                    values=tuple(values),
                    period=TURN_DEG,
                )
                for acts_on, values in curves.items()
            )
        ),
    )
