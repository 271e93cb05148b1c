"""A shaft that cracks near the chuck, or a collet that comes loose: a spring between drive and needle.

It is there from an unknown time on, and stays so in the trials that follow, or to the end of that
trial. The needle turns by the angle of the drive less

    compliance * torque.

It takes torque off the needle as less damping does, so that the starting value of the time is that of
tissue that gives way (changes.py).
"""

from dataclasses import replace
from functools import partial

from diagnosis.effects.effect import Parameter, Place
from diagnosis.freeform.families.in_time.changes import changes_of
from diagnosis.freeform.families.in_time.events import (
    Moment,
    around,
    change_between,
    event_family,
    times_of,
)
from diagnosis.freeform.family import Family, Points
from diagnosis.freeform.ranges import LogRanges
from diagnosis.log.trial import TIP
from diagnosis.replay.curve import ActsOn, Course, Curve
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.replay.variables import Variable

_PLACES = {Place.DRIVE: 0.6, Place.NEEDLE: 0.4}
_STARTS, _LEAST, _MOST = (0.5, 2.0), 0.01, 100.0  # of what is missing at the tip, per largest torque
_BEYOND = 1.5  # torque that the curve spans / that of the nominal rig


def families(ranges: LogRanges) -> tuple[Family, ...]:
    """Both, if tip and torque are measured and less damping was simulated."""
    if not ranges.softer or TIP not in ranges.missing or Variable.TORQUE not in ranges.ends:
        return ()
    return tuple(_cracks(ranges, *change) for change in changes_of(ranges))


def _cracks(ranges: LogRanges, moment: Moment, after: tuple[str, ...]) -> Family:
    """The spring; in trials `after` that of the crack, it is there from the start."""
    most_n_mm = max(abs(end) for end in ranges.ends[Variable.TORQUE])
    usual = ranges.missing[TIP] / most_n_mm
    compliance = Parameter(
        name="compliance",
        unit="deg / N mm",
        low=_LEAST * usual,
        high=_MOST * usual,
        start=tuple(share * usual for share in _STARTS),
        logarithmic=True,
        neutral=None,
    )
    when, lasting = (replace(p, start=len(_STARTS) * p.start) for p in times_of(moment))
    return event_family(
        moment,
        after,
        what="compliance at the chuck",
        in_words="a shaft that cracks near the chuck, or a collet that comes loose",
        told="compliance at the chuck",
        places=_PLACES,
        parameters=(when, lasting, compliance),
        apply=partial(_apply, moment.trial, after, _BEYOND * most_n_mm),
        curve=_given_way,
        unit="deg / N mm",
    )


def _given_way(time_s: float, duration_s: float, compliance: float) -> Points:
    return change_between(time_s, duration_s, 0.0, compliance)


def _apply(
    trial: str,
    after: tuple[str, ...],
    most_n_mm: float,
    rig: RigParameters,
    time_s: float,
    duration_s: float,
    compliance: float,
) -> RigParameters:
    spring = partial(
        Curve,
        acts_on=ActsOn.DRIVE_ANGLE,
        variable=Variable.TORQUE,
        places=(-most_n_mm, most_n_mm),
        values=(compliance * most_n_mm, -compliance * most_n_mm),
    )
    begins = Course(variable=Variable.TIME, places=around(time_s, duration_s), values=(0.0, 1.0))
    later = (spring(trial=name) for name in after)
    return replace(rig, free=FreeLaw(curves=(spring(trial=trial, factor=begins), *later)))
