"""Free laws of the chuck, in which the needle turns where it carries more than a torque.

- it slips; or the tissue does so in its holder, gives before, and takes the needle with it
- it slips between stops, and a spring brings it back: play that rubs, a coupling that is soft, then
  stiff, one with hysteresis; or the tissue does, a block that is loose in its holder

The torque at which it first gives way is looked for below the largest that the nominal rig asks for.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import replace

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.freeform.family import Family, Points
from diagnosis.freeform.ranges import LogRanges
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.free_parts.free_coupling import FreeCoupling
from diagnosis.replay.free_parts.free_grip import FreeGrip
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.replay.variables import Variable

_STARTS = (0.9, 0.6, 0.35)  # of the largest torque
_LEAST = 0.02
_LEAST_RUB, _MOST_SOFT = 1e-3, 30.0  # of the largest torque; per rad
_COUPLINGS = tuple(
    (rub, play_deg, soft)
    for play_deg in (2.0, 6.0, 20.0)
    for rub, soft in ((0.02, 0.0), (0.1, 0.0), (0.25, 0.0), (0.5, 0.0), (0.01, 3.0), (0.3, 1.0))
)  # to start with: friction and spring in these units, and play
_FIRM = 300.0  # stiffness of a holder over the largest torque, per rad: it gives by 0.2 deg
_PLACES = {Place.DRIVE: 1.0}


def families(ranges: LogRanges) -> tuple[Family, ...]:
    """The chuck, if the torque of a log has ends."""
    if Variable.TORQUE not in ranges.ends:
        return ()
    most_n_mm = max(abs(end) for end in ranges.ends[Variable.TORQUE])
    grip, coupling = _grip(most_n_mm), _coupling(most_n_mm)
    return grip, _holder(grip, most_n_mm), coupling, _loose_holder(coupling)


def _torque(most_n_mm: float, least: float, starts: Sequence[float]) -> Parameter:
    return Parameter(
        name="torque",
        unit="N mm",
        low=least * most_n_mm,
        high=2.0 * most_n_mm,
        start=tuple(share * most_n_mm for share in starts),
        logarithmic=True,
        neutral=None,
    )


def _grip(most_n_mm: float) -> Family:
    return Family(
        effect=Effect(
            name="slip in the chuck over torque",
            title="a needle that slips in its chuck beyond a torque",
            place=Place.DRIVE,
            parameters=(_torque(most_n_mm, _LEAST, _STARTS),),
            apply=_apply,
            differences=(1e-2, 1e-3),
        ),
        places=_PLACES,
        says="torque",
        title="torque that the chuck holds",
        curve=_held,
        x_unit="deg",
        unit="N mm",
    )


def _of_tissue(
    chuck: Family, *, name: str, title: str, told: str, apply: Callable[..., RigParameters]
) -> Family:
    """The law of a chuck as one of the tissue in its holder."""
    effect = replace(chuck.effect, name=name, title=title, place=Place.TISSUE, apply=apply)
    return replace(chuck, effect=effect, places={Place.TISSUE: 1.0}, title=told)


def _holder(grip: Family, most_n_mm: float) -> Family:
    holder = _of_tissue(
        grip,
        name="slip of the tissue over torque",
        title="tissue that slips in its holder beyond a torque, and gives before",
        told="torque at which the tissue turns in its holder",
        apply=_apply_holder,
    )
    gives = Parameter(
        name="stiffness",
        unit="N mm / rad",
        low=most_n_mm,
        high=1e4 * most_n_mm,
        start=(_FIRM * most_n_mm,) * len(_STARTS),
        logarithmic=True,
        neutral=math.inf,
    )
    effect = replace(holder.effect, parameters=(*holder.effect.parameters, gives))
    return replace(holder, effect=effect)


def _apply_holder(rig: RigParameters, torque: float, stiffness: float) -> RigParameters:
    gives = None if math.isinf(stiffness) else stiffness
    law = FreeLaw(
        grip=FreeGrip(torque_n_mm=torque, of_tissue=True),
        coupling=FreeCoupling(stiffness_n_mm_per_rad=gives),
    )
    return replace(rig, free=law)


def _held(torque: float, *_: float) -> Points:
    return (0.0, 10.0), (torque, torque)


def _apply(rig: RigParameters, torque: float) -> RigParameters:
    return replace(rig, free=FreeLaw(grip=FreeGrip(torque_n_mm=torque)))


def _coupling(most_n_mm: float) -> Family:
    rubs, plays_deg, soft = zip(*_COUPLINGS, strict=True)
    play = Parameter(
        name="play", unit="deg", low=0.2, high=360.0, start=plays_deg, logarithmic=True, neutral=None
    )
    spring = Parameter(
        name="stiffness",
        unit="N mm / rad",
        low=0.0,
        high=_MOST_SOFT * most_n_mm,
        start=tuple(share * most_n_mm for share in soft),
        scale=most_n_mm,
    )
    return Family(
        effect=Effect(
            name="slip between stops over torque",
            title="a chuck that gives way between stops, with friction and a spring",
            place=Place.DRIVE,
            parameters=(_torque(most_n_mm, _LEAST_RUB, rubs), play, spring),
            apply=_apply_coupling,
            differences=(1e-2, 1e-3),
        ),
        places=_PLACES,
        says="torque",
        title="torque at which the needle slips in its chuck, between two stops",
        curve=_taken,
        x_unit="deg",
        unit="N mm",
    )


def _loose_holder(coupling: Family) -> Family:
    return _of_tissue(
        coupling,
        name="slip of the tissue between stops over torque",
        title="tissue that is loose in its holder, between stops, with friction and a spring",
        told="torque at which the tissue slips in its holder, between two stops",
        apply=_apply_loose_holder,
    )


def _apply_loose_holder(
    rig: RigParameters, torque: float, play_deg: float, stiffness: float
) -> RigParameters:
    grip = FreeGrip(
        torque_n_mm=torque,
        play_deg=play_deg,
        stiffness_n_mm_per_rad=stiffness,
        of_tissue=True,
    )
    return replace(rig, free=FreeLaw(grip=grip))


def _taken(torque: float, play_deg: float, stiffness: float) -> Points:
    stop_deg = 0.5 * play_deg
    return (0.0, stop_deg), (torque, torque + stiffness * math.radians(stop_deg))


def _apply_coupling(
    rig: RigParameters, torque: float, play_deg: float, stiffness: float
) -> RigParameters:
    grip = FreeGrip(torque_n_mm=torque, play_deg=play_deg, stiffness_n_mm_per_rad=stiffness)
    return replace(rig, free=FreeLaw(grip=grip))
