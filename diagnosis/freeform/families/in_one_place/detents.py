"""Free laws of a torque at the tip that comes back several times in a turn: a detent, a cut edge.

    torque = sum over m = 1 .. 4 of a_m sin(m n angle) + b_m cos(m n angle)

n times in a turn, for several n: narrow wells, which one to four waves per turn (angle.py) miss.
"""

from dataclasses import replace
from functools import partial

from diagnosis.effects.effect import Effect, Place
from diagnosis.freeform.families.angle import over_angles, shown_deg, waves_over
from diagnosis.freeform.families.in_one_place.tip import AT_TIP_MM
from diagnosis.freeform.family import Family, coordinates
from diagnosis.freeform.ranges import LogRanges
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.replay.variables import Variable

TIMES_A_TURN = (2, 3, 4, 6, 12)
_WAVES = 4
_SHOWN = 193  # angles at which a law is shown: sixteen in the shortest period


def families(ranges: LogRanges) -> tuple[Family, ...]:
    """One for each number of times in a turn, if the base turns."""
    if Variable.BASE_ANGLE not in ranges.ends:
        return ()
    return tuple(_detent(ranges, times) for times in TIMES_A_TURN)


def _detent(ranges: LogRanges, times: int) -> Family:
    waves = tuple(times * m for m in range(1, _WAVES + 1))
    return Family(
        effect=Effect(
            name=f"tip torque over tip_angle, {times} times a turn",
            title=f"tip torque that depends on its angle, {times} times a turn",
            place=Place.NEEDLE,
            parameters=coordinates(2 * _WAVES, 0, ranges.dry_level.start[-1] * AT_TIP_MM),
            apply=partial(_apply, waves),
        ),
        places={Place.NEEDLE: 1.0},
        says="tip_angle",
        title="tip torque",
        curve=partial(over_angles, shown_deg(ranges, _SHOWN), waves),
        x_unit="deg",
        unit="N mm",
    )


def _apply(waves: tuple[int, ...], rig: RigParameters, *c: float) -> RigParameters:
    return replace(rig, free=FreeLaw(at_tip=waves_over(waves, c)))
