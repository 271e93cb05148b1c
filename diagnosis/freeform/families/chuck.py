"""A free law of the chuck: the needle slips in it where it carries more than a torque.

The torque at which it first slips is looked for below the largest that the nominal rig asks for.
"""

from dataclasses import replace

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.freeform.family import Family, Points
from diagnosis.freeform.ranges import LogRanges
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.replay.variables import Variable

_STARTS = (0.9, 0.6, 0.35)  # of the largest torque
_LEAST = 0.02


def families(ranges: LogRanges) -> tuple[Family, ...]:
    """The chuck, if the torque of a log has ends."""
    return (_grip(ranges),) if Variable.TORQUE in ranges.ends else ()


def _grip(ranges: LogRanges) -> Family:
    most_n_mm = max(abs(end) for end in ranges.ends[Variable.TORQUE])
    torque = Parameter(
        name="torque",
        unit="N mm",
        low=_LEAST * most_n_mm,
        high=2.0 * most_n_mm,
        start=tuple(share * most_n_mm for share in _STARTS),
        logarithmic=True,
        neutral=None,
    )
    return Family(
        effect=Effect(
            name="slip in the chuck over torque",
            title="a needle that slips in its chuck beyond a torque",
            place=Place.DRIVE,
            parameters=(torque,),
            apply=_apply,
            differences=(1e-2, 1e-3),
        ),
        places={Place.DRIVE: 1.0},
        says="torque",
        title="torque that the chuck holds",
        curve=_held,
        x_unit="deg",
        unit="N mm",
    )


def _held(torque: float) -> Points:
    return (0.0, 10.0), (torque, torque)


def _apply(rig: RigParameters, torque: float) -> RigParameters:
    return replace(rig, free=FreeLaw(grip_torque_n_mm=torque))
