"""A free law of tissue that the needle had not been in before the trial.

Behind the depth at which a trial began, the needle lies in a channel that it has cut before. Beyond, its
damping is another, and there may be dry friction.
"""

from dataclasses import replace
from functools import partial

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.freeform.family import VISCOUS, Family, Points
from diagnosis.freeform.ranges import LogRanges
from diagnosis.replay.along_depth import AlongDepth
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.replay.variables import Variable

_SHOWN_MM, _STEP_MM = 20.0, 1e-3  # either side of the start, and from one to the other as it is drawn
_TIMES = Parameter(
    name="times",
    unit="-",
    low=0.02,
    high=50.0,
    start=(2.0, 0.5, 1.0),
    logarithmic=True,
    neutral=1.0,
)


def families(ranges: LogRanges) -> tuple[Family, ...]:
    """The law, if the needle slides clearly in some trial."""
    return (_beyond_start(ranges),) if Variable.ADVANCED_BY in ranges.ends else ()


def _beyond_start(ranges: LogRanges) -> Family:
    level = ranges.dry_level
    little = level.start[0]
    return Family(
        effect=Effect(
            name="damping and dry friction over depth, beyond the start",
            title="friction of tissue that the needle had not been in before the trial",
            place=Place.INTERFACE,
            parameters=(_TIMES, replace(level, start=(little, little, level.start[-1]))),
            apply=_apply,
            differences=(1e-2,),
        ),
        places={Place.INTERFACE: 0.5, Place.TISSUE: 0.5},
        says=Variable.DEPTH,
        title="damping along the shaft",
        curve=partial(_damping, ranges.damping_n_mm_s_per_mm),
        x_unit="mm beyond the depth at which the trial began",
        unit=VISCOUS,
    )


def _damping(beta: float, times: float, _: float) -> Points:
    return (-_SHOWN_MM, 0.0, _STEP_MM, _SHOWN_MM), (beta, beta, beta * times, beta * times)


def _apply(rig: RigParameters, times: float, level: float) -> RigParameters:
    along = AlongDepth(damping=(1.0, times), friction_n_mm_per_mm=(0.0, level), from_start=True)
    return replace(rig, free=FreeLaw(along_depth=along))
