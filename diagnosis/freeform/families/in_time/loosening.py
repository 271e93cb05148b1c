"""A chuck that works loose, as by a set screw: play between drive and needle, from an unknown time on.

It opens in that trial, and stays in the trials that follow, or to the end of that trial. It takes torque
off the needle as less damping does, so that the starting value of the time is that of tissue that gives
way (changes.py).
"""

from dataclasses import replace
from functools import partial

from diagnosis.effects.effect import Place
from diagnosis.freeform.families.in_time.changes import changes_of
from diagnosis.freeform.families.in_time.events import (
    Moment,
    change_between,
    event_family,
    times_of,
)
from diagnosis.freeform.family import Family, Points
from diagnosis.freeform.ranges import LogRanges
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.free_parts.free_play import FreePlay
from diagnosis.replay.rig_parameters import RigParameters

_THERE_S = 0.01  # from the start of a trial on


def families(ranges: LogRanges) -> tuple[Family, ...]:
    """Both, if less damping was simulated."""
    return tuple(_loosens(ranges, *change) for change in changes_of(ranges)) if ranges.softer else ()


def _loosens(ranges: LogRanges, moment: Moment, after: tuple[str, ...]) -> Family:
    """The play; in trials `after` that of the event, it is there from the start."""
    (gap,) = ranges.library["chuck_backlash"].parameters
    when, lasting = (replace(p, start=len(gap.start) * p.start) for p in times_of(moment))
    return event_family(
        moment,
        after,
        what="play of the chuck",
        in_words="a chuck that works loose",
        told="play of the chuck",
        places={Place.DRIVE: 1.0},
        parameters=(when, lasting, replace(gap, neutral=None)),
        apply=partial(_apply, moment.trial, after),
        curve=_opened,
        unit="deg",
    )


def _opened(time_s: float, duration_s: float, play_deg: float) -> Points:
    return change_between(time_s, duration_s, 0.0, play_deg)


def _apply(
    trial: str,
    after: tuple[str, ...],
    rig: RigParameters,
    time_s: float,
    duration_s: float,
    play_deg: float,
) -> RigParameters:
    opens = FreePlay(trial=trial, play_deg=play_deg, from_s=time_s - 0.5 * duration_s, over_s=duration_s)
    later = (replace(opens, trial=name, from_s=-_THERE_S, over_s=_THERE_S) for name in after)
    return replace(rig, free=FreeLaw(plays=(opens, *later)))
