"""Tissue that turns once, in one trial, and takes the needle with it: a muscle that twitches.

It moves the needle by the rate at which it turns, as a torque along the inserted shaft would. Where it
stays, it does nothing more. The time starts where an event of the tip sensor would (events.py).
"""

from dataclasses import replace

from diagnosis.effects.effect import Place
from diagnosis.freeform.families.in_time.events import events, started, step, times_of
from diagnosis.freeform.family import Family
from diagnosis.freeform.ranges import LogRanges
from diagnosis.log.trial import TIP
from diagnosis.replay.curve import ActsOn

_TAKES_S, _LONGEST_S = (0.3, 3.0), 10.0
_PLACES = {Place.TISSUE: 0.6, Place.INTERFACE: 0.4}


def families(ranges: LogRanges) -> tuple[Family, ...]:
    """The law, if the tip was read for long enough."""
    moments = events(ranges, TIP) if TIP in ranges.missing else ()
    if not moments:
        return ()
    size = max(ranges.missing[TIP], ranges.problem.noise[TIP])
    once = step(ActsOn.TISSUE_ANGLE, Place.TISSUE, "turn of the tissue", moments[0], size, ())
    when, lasting = times_of(moments[0])
    times = (
        replace(when, start=len(_TAKES_S) * when.start),
        replace(lasting, high=_LONGEST_S, start=_TAKES_S),
    )
    effect = replace(once.effect, parameters=started(times, size))
    return (replace(once, effect=effect, places=_PLACES),)
