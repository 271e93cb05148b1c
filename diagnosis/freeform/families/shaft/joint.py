"""Free laws of a joint in the shaft: with play, or a torsion spring (a kink, a flexure).

The spring is told by the length of shaft that twists as much: kappa / stiffness, with the torsional
rigidity kappa.
"""

from collections.abc import Callable
from dataclasses import replace
from functools import partial

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.freeform.family import Family, Points
from diagnosis.freeform.ranges import LogRanges
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.free_parts.free_shaft import FreeShaft
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.replay.variables import Variable

_JOINTS_AT = (0.1, 0.25, 0.45, 0.65)  # of the shaft from the tip on, to start with
_PLAY_DEG, _SHARE = 5.0, 0.3  # to start with; of the shaft that twists as much
_MOST_TIMES = 20.0  # the shaft that twists as much: it hangs on a thread


def families(ranges: LogRanges) -> tuple[Family, ...]:
    """The laws of a joint with play, and of a soft one."""
    if Variable.TORQUE not in ranges.ends:
        return ()
    longest_mm = ranges.longest_mm
    play = _law(
        longest_mm,
        _size("play", "deg", _PLAY_DEG, most=90.0),
        name="joint of the shaft over position",
        what="a joint in the shaft, with play",
        title="play of the shaft from the tip to there",
        apply=_apply_play,
    )
    spring = _law(
        longest_mm,
        _size("length", "mm", _SHARE * longest_mm, most=_MOST_TIMES * longest_mm),
        name="spring in the shaft over position",
        what="a torsion spring in the shaft",
        title="length of shaft that twists as much as a joint between the tip and there",
        apply=_apply_spring,
    )
    return play, spring


def _size(name: str, unit: str, start: float, *, most: float) -> Parameter:
    return Parameter(
        name=name, unit=unit, low=0.0, high=most, start=(start,) * len(_JOINTS_AT), scale=start
    )


def _law(
    longest_mm: float,
    size: Parameter,
    *,
    name: str,
    what: str,
    title: str,
    apply: Callable[..., RigParameters],
) -> Family:
    """A law of a joint of some size at some place, which starts from several places."""
    place = Parameter(
        name="place",
        unit="mm",
        low=0.0,
        high=longest_mm,
        start=tuple(share * longest_mm for share in _JOINTS_AT),
        scale=0.3 * longest_mm,
        neutral=None,
    )
    return Family(
        effect=Effect(
            name=name,
            title=what,
            place=Place.NEEDLE,
            parameters=(size, place),
            apply=apply,
            differences=(1e-2,),
        ),
        places={Place.NEEDLE: 1.0},
        says="position",
        title=title,
        curve=partial(_beyond, longest_mm),
        x_unit="mm from the tip",
        unit=size.unit,
    )


def _beyond(longest_mm: float, size: float, place_mm: float) -> Points:
    """What a joint adds between the tip and a place."""
    return (0.0, place_mm, place_mm + 1.0, longest_mm + 2.0), (0.0, 0.0, size, size)


def _apply_play(rig: RigParameters, play_deg: float, place_mm: float) -> RigParameters:
    return replace(
        rig, free=FreeLaw(shaft=FreeShaft(joint_play_deg=play_deg, joint_from_tip_mm=place_mm))
    )


def _apply_spring(rig: RigParameters, length_mm: float, place_mm: float) -> RigParameters:
    return replace(
        rig, free=FreeLaw(shaft=FreeShaft(joint_length_mm=length_mm, joint_from_tip_mm=place_mm))
    )
