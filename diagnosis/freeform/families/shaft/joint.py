"""A free law of a joint in the shaft, with play."""

from dataclasses import replace
from functools import partial

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.freeform.family import Family, Points
from diagnosis.freeform.ranges import LogRanges
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.free_parts.free_shaft import FreeShaft
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.replay.variables import Variable

_JOINTS_AT, _PLAY_DEG = (0.1, 0.25, 0.45, 0.65), 5.0  # of the shaft from the tip on, to start with


def families(ranges: LogRanges) -> tuple[Family, ...]:
    """The law of a joint with play."""
    return (_joint(ranges),) if Variable.TORQUE in ranges.ends else ()


def _joint(ranges: LogRanges) -> Family:
    longest_mm = ranges.longest_mm
    play = Parameter(
        name="play",
        unit="deg",
        low=0.0,
        high=90.0,
        start=(_PLAY_DEG,) * len(_JOINTS_AT),
        scale=_PLAY_DEG,
    )
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
            name="joint of the shaft over position",
            title="a joint in the shaft, with play",
            place=Place.NEEDLE,
            parameters=(play, place),
            apply=_apply_joint,
            differences=(1e-2,),
        ),
        places={Place.NEEDLE: 1.0},
        says="position",
        title="play of the shaft from the tip to there",
        curve=partial(_play, longest_mm),
        x_unit="mm from the tip",
        unit="deg",
    )


def _play(longest_mm: float, play_deg: float, place_mm: float) -> Points:
    return (0.0, place_mm, place_mm + 1.0, longest_mm + 2.0), (0.0, 0.0, play_deg, play_deg)


def _apply_joint(rig: RigParameters, play_deg: float, place_mm: float) -> RigParameters:
    return replace(
        rig, free=FreeLaw(shaft=FreeShaft(joint_play_deg=play_deg, joint_from_tip_mm=place_mm))
    )
