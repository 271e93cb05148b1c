"""Free laws of the shaft of the needle.

- its stiffness as a curve of the torque that it carries, either way
- its stiffness as a curve of the place along it: a joint, a thinner or a hollow part
- its stiffness as a curve of the time: a shaft that is warmed, or cracks
- a shaft that twists plastically beyond a torque
- a shaft that creeps: a torque twists it further in time
- a shaft whose material damps: it resists the rate at which it twists
- a joint in the shaft, with play
"""

from collections.abc import Sequence
from dataclasses import replace
from functools import partial

import numpy as np

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.freeform.family import Family, Points, coordinates_of
from diagnosis.freeform.ranges import LEAST_PAST_S, LONGEST_PAST_S, LogRanges
from diagnosis.freeform.smooth_curve import SmoothCurve, rough_curve, smooth_curve, two_sided_curve
from diagnosis.replay.curve import ActsOn
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.replay.variables import SAYS, UNITS, Variable
from models.needle import STIFFNESS_POINTS

_YIELDS_AT = (0.85, 0.55, 0.3)  # of the largest torque, to start with
_LEAST_YIELD, _YIELD_SLOPE = 0.02, 0.4
_BEYOND = 1.5  # torque that a curve spans / that of the nominal shaft: one that yields twists more
_STIFFENS = 0.5  # of the logarithm of the stiffness, to start with
_CREEPS_BY, _CREEPS_S, _CREEP_POINTS = 0.3, (0.3, 2.0, 10.0), 11
_DAMPS_S, _SHOWN_PER_S = (0.02, 0.3), 2.0
_PARTS = 10  # of the longest shaft
_JOINTS_AT, _PLAY_DEG = (0.1, 0.25, 0.45, 0.65), 5.0  # of it from the tip on, to start with


def families(ranges: LogRanges) -> tuple[Family, ...]:
    """Families of laws that the shaft may lack."""
    if Variable.TORQUE not in ranges.ends:
        return ()
    of_time = (_over(v, ranges) for v in (Variable.TIME, Variable.TRIAL_SHARE) if v in ranges.ends)
    numbers = (_yielding(ranges), _creeping(), _damping(), _joint(ranges))
    return (_stiffness(ranges), _along(ranges), *of_time, *numbers)


def _stiffness(ranges: LogRanges) -> Family:
    most_n_mm = _BEYOND * max(abs(end) for end in ranges.ends[Variable.TORQUE])
    curve = two_sided_curve(most_n_mm, STIFFNESS_POINTS)
    return Family(
        effect=Effect(
            name="stiffness over torque",
            title="a shaft whose stiffness changes with the torque that it carries",
            place=Place.NEEDLE,
            parameters=_either_way(coordinates_of(curve)),
            apply=partial(_apply_stiffness, curve, most_n_mm),
        ),
        places={Place.NEEDLE: 1.0},
        says="torque",
        title="stiffness of the shaft over the nominal",
        curve=partial(_factors, curve),
        x_unit="N mm",
        unit="-",
    )


def _either_way(parameters: Sequence[Parameter]) -> tuple[Parameter, ...]:
    """Parameters of a shaft that starts as one that is stiffer, or softer, under a large torque."""
    level, size, *rest = (replace(p, start=(0.0, 0.0)) for p in parameters)
    return (level, replace(size, start=(_STIFFENS, -_STIFFENS)), *rest)


def _factors(curve: SmoothCurve, *c: float) -> Points:
    return curve.places, curve.factors(c)


def _by_sign(factors: Sequence[float]) -> tuple[float, ...]:
    """Of negative torques from 0, then of positive ones; they come in the order of the torques."""
    negative, positive = factors[:STIFFNESS_POINTS], factors[STIFFNESS_POINTS:]
    return (*negative[::-1], *positive)


def _apply_stiffness(
    curve: SmoothCurve, most_n_mm: float, rig: RigParameters, *c: float
) -> RigParameters:
    law = FreeLaw(stiffness_over_torque=_by_sign(curve.factors(c)), stiffness_torque_n_mm=most_n_mm)
    return replace(rig, free=law)


def _longest_mm(ranges: LogRanges) -> float:
    """Of the shaft, in all trials."""
    trials = ranges.problem.log.trials
    return max(float((trial.free_mm + trial.inserted_mm).max()) for trial in trials)


def _along(ranges: LogRanges) -> Family:
    curve = rough_curve(0.0, _longest_mm(ranges), _PARTS)
    return Family(
        effect=Effect(
            name="stiffness over position",
            title="a shaft whose stiffness changes along it",
            place=Place.NEEDLE,
            parameters=coordinates_of(curve),
            apply=partial(_apply_along, curve),
        ),
        places={Place.NEEDLE: 1.0},
        says="position",
        title="stiffness of the shaft over the nominal",
        curve=partial(_factors, curve),
        x_unit="mm from the tip",
        unit="-",
    )


def _apply_along(curve: SmoothCurve, rig: RigParameters, *c: float) -> RigParameters:
    law = FreeLaw(stiffness_along=curve.factors(c), stiffness_along_mm=float(curve.places[-1]))
    return replace(rig, free=law)


def _over(variable: Variable, ranges: LogRanges) -> Family:
    curve = smooth_curve(*ranges.ends[variable])
    return Family(
        effect=Effect(
            name=f"stiffness over {variable}",
            title=f"a shaft whose stiffness changes with {variable}",
            place=Place.PARAMETERS,
            parameters=coordinates_of(curve),
            apply=partial(_apply_over, variable, curve),
        ),
        places={Place.PARAMETERS: 0.6, Place.NEEDLE: 0.4},
        says=SAYS.get(variable, variable),
        title="stiffness of the shaft over the nominal",
        curve=partial(_factors, curve),
        x_unit=UNITS[variable],
        unit="-",
    )


def _apply_over(variable: Variable, curve: SmoothCurve, rig: RigParameters, *c: float) -> RigParameters:
    own = curve.acting_on(ActsOn.STIFFNESS, variable, c)
    return replace(rig, free=FreeLaw(tissue_varies=True, curves=(own,)))


def _yielding(ranges: LogRanges) -> Family:
    most_n_mm = max(abs(end) for end in ranges.ends[Variable.TORQUE])
    starts = tuple(share * most_n_mm for share in _YIELDS_AT)
    torque = Parameter(
        name="torque",
        unit="N mm",
        low=_LEAST_YIELD * most_n_mm,
        high=2.0 * most_n_mm,
        start=starts,
        logarithmic=True,
        neutral=None,
    )
    slope = Parameter(
        name="slope", unit="-", low=0.0, high=0.98, start=(_YIELD_SLOPE,) * len(starts), neutral=1.0
    )
    return Family(
        effect=Effect(
            name="plastic twist over torque",
            title="a shaft that twists plastically beyond a torque",
            place=Place.NEEDLE,
            parameters=(torque, slope),
            apply=_apply_yielding,
            differences=(1e-2, 1e-3),
        ),
        places={Place.NEEDLE: 1.0},
        says="torque",
        title="torque of the shaft over its twist",
        curve=_yields,
        x_unit="of the twist at which it yields",
        unit="N mm",
    )


def _yields(torque: float, slope: float) -> Points:
    twists = np.array([0.0, 1.0, 3.0])
    return twists, torque * np.array([0.0, 1.0, 1.0 + 2.0 * slope])


def _apply_yielding(rig: RigParameters, torque: float, slope: float) -> RigParameters:
    return replace(rig, free=FreeLaw(yield_torque_n_mm=torque, yield_stiffness_ratio=slope))


def _creeping() -> Family:
    time = Parameter(
        name="time",
        unit="s",
        low=LEAST_PAST_S,
        high=LONGEST_PAST_S,
        start=_CREEPS_S,
        logarithmic=True,
        neutral=None,
    )
    ratio = Parameter(
        name="ratio",
        unit="-",
        low=1e-3,
        high=10.0,
        start=(_CREEPS_BY,) * len(_CREEPS_S),
        logarithmic=True,
    )
    return Family(
        effect=Effect(
            name="creep of the shaft over past",
            title="a shaft that creeps under a torque",
            place=Place.NEEDLE,
            parameters=(ratio, time),
            apply=_apply_creep,
            differences=(1e-2,),
        ),
        places={Place.NEEDLE: 1.0},
        says="history",
        title="twist of the shaft over the elastic one",
        curve=_creep,
        x_unit="s under a torque",
        unit="-",
    )


def _creep(ratio: float, time_s: float) -> Points:
    at_s = time_s * np.linspace(0.0, 5.0, _CREEP_POINTS)
    return at_s, 1.0 - ratio * np.expm1(-at_s / time_s)


def _apply_creep(rig: RigParameters, ratio: float, time_s: float) -> RigParameters:
    return replace(rig, free=FreeLaw(creep_ratio=ratio, creep_time_s=time_s))


def _damping() -> Family:
    time = Parameter(
        name="time",
        unit="s",
        low=1e-3,
        high=10.0,
        start=_DAMPS_S,
        logarithmic=True,
    )
    return Family(
        effect=Effect(
            name="damping of the shaft over rate",
            title="a shaft whose material resists the rate at which it twists",
            place=Place.NEEDLE,
            parameters=(time,),
            apply=_apply_damping,
            differences=(1e-2,),
        ),
        places={Place.NEEDLE: 1.0},
        says="rate",
        title="torque of the shaft over the elastic one",
        curve=_damped,
        x_unit="rate over twist, 1/s",
        unit="-",
    )


def _damped(time_s: float) -> Points:
    per_s = np.linspace(0.0, _SHOWN_PER_S, 3)
    return per_s, 1.0 + time_s * per_s


def _apply_damping(rig: RigParameters, time_s: float) -> RigParameters:
    return replace(rig, free=FreeLaw(shaft_damping_s=time_s))


def _joint(ranges: LogRanges) -> Family:
    longest_mm = _longest_mm(ranges)
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
    return replace(rig, free=FreeLaw(joint_play_deg=play_deg, joint_from_tip_mm=place_mm))
