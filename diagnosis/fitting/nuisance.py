"""Nuisance parameters: what is never known exactly about a rig, and is fitted every time.

Stiffness and damping scatter by a few per cent about the nominal values. If the
needle slides while it is twisted, it is unknown which rate the tissue resists: the spatial derivative at
a fixed place, as in the paper's equation (9), or the material derivative of the sliding shaft;
this is fitted separately for trials of constant depth and of growing depth.

Each trial that began late has its own parameters for the motion of the base before it; and each trial,
where the clock of a sensor drifts, one for how long it ran before, if that explains the log. And where a
reading jumps within a trial, the size of that is fitted. Of readings that were smoothed after
recording, what the filter did to slow ones is fitted.
"""

from dataclasses import replace
from functools import partial

from diagnosis.criteria.fitting import SCATTER
from diagnosis.criteria.prepare import START_SPREAD_DEG
from diagnosis.effects import LIBRARY
from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.prepare.prepared_log import PreparedLog
from diagnosis.replay.rig_parameters import Past, RigParameters
from diagnosis.replay.sensing.reading_errors import ClockStart, ReadingJump, SmoothedReading
from sim.discretisation import Mesh

# A share between 0 and 1 is as good as open with this standard deviation.
CONVENTIONS = {"slip_constant_depth": 0.5, "slip_growing_depth": 0.5}
PRIOR_SIGMA = SCATTER | CONVENTIONS
_START_UNIT_DEG, _MOST_TURN_DEG = 30.0, 3600.0
_MOST_BEFORE_S = 3600.0  # that a clock ran before a trial: a session
_MOST_JUMP = 1e4  # sigma of the reading


def prior_sigma(effect: Effect) -> float:
    """Standard deviation of a nuisance effect's prior, in the units of the fit; infinite: none."""
    return PRIOR_SIGMA.get(effect.name, effect.parameters[0].prior_sigma)


def _constant_depth(rig: RigParameters, share: float) -> RigParameters:
    return replace(rig, material_share_constant_depth=share)


def _growing_depth(rig: RigParameters, share: float) -> RigParameters:
    return replace(rig, material_share_growing_depth=share)


_TURN = Parameter(
    name="turned",
    unit="deg",
    low=-_MOST_TURN_DEG,
    high=_MOST_TURN_DEG,
    start=(0.0,),
    scale=_START_UNIT_DEG,
    reported=False,
    prior_sigma=START_SPREAD_DEG / _START_UNIT_DEG,
)
_SHARE = Parameter(name="share", unit="-", low=0.0, high=1.0, start=(0.0,))
_COEFFICIENT = Parameter(
    name="second", unit="-", low=-6.0, high=6.0, start=(0.0,), scale=0.2, reported=False
)
SLIP_CONSTANT_DEPTH = Effect(
    name="slip_constant_depth",
    title="the rate that the tissue resists, at constant depth",
    place=Place.INTERFACE,
    parameters=(_SHARE,),
    apply=_constant_depth,
)
SLIP_GROWING_DEPTH = Effect(
    name="slip_growing_depth",
    title="the rate that the tissue resists, at growing depth",
    place=Place.INTERFACE,
    parameters=(_SHARE,),
    apply=_growing_depth,
)


def _with_past(trial: str, rig: RigParameters, turned_deg: float, wound_deg: float) -> RigParameters:
    past = Past(trial=trial, wound_deg=wound_deg, turned_deg=turned_deg)
    return replace(rig, pasts=(*rig.pasts, past))


def late_starts_of(log: PreparedLog) -> tuple[Effect, ...]:
    """Nuisance effects for the motion of the base before each trial that began late."""
    return tuple(
        Effect(
            name=f"start of {trial.name}",
            title=f"what the base turned by before {trial.name} began",
            place=Place.DRIVE,
            parameters=(_TURN, replace(_TURN, name="wound")),
            apply=partial(_with_past, trial.name),
            trial=trial.name,
        )
        for trial in log.trials
        if trial.late_start is not None
    )


def _with_clock(trial: str, sensor: str, rig: RigParameters, before_s: float) -> RigParameters:
    own = ClockStart(trial=trial, sensor=sensor, before_s=before_s)
    return replace(rig, clock_starts=(*rig.clock_starts, own))


def clock_starts_of(log: PreparedLog, sensor: str) -> tuple[Effect, ...]:
    """Nuisance effects for how long the clock of a sensor ran before each trial."""
    before = Parameter(
        name="before", unit="s", low=0.0, high=_MOST_BEFORE_S, start=(0.0,), reported=False
    )
    return tuple(
        Effect(
            name=f"clock of {sensor} before {trial.name}",
            title=f"how long the clock of {sensor} ran before {trial.name} began",
            place=Place.SENSOR,
            parameters=(before,),
            apply=partial(_with_clock, trial.name, sensor),
            needs=sensor,
            trial=trial.name,
        )
        for trial in log.trials
        if trial.has(sensor)
    )


def _with_jump(jump: ReadingJump, rig: RigParameters, size: float) -> RigParameters:
    return replace(rig, jumps=(*rig.jumps, replace(jump, size=size)))


def reading_jump(jump: ReadingJump, *, sigma: float) -> Effect:
    """The nuisance effect of a reading that jumps, by a size that is open.

    Args:
      jump: begun from its size.
      sigma: noise of the reading, the unit of the fit.
    """
    what = f"{jump.sensor} in {jump.trial} at {jump.time_s:g} s"
    size = Parameter(
        name="size",
        unit=jump.unit,
        low=-_MOST_JUMP * sigma,
        high=_MOST_JUMP * sigma,
        start=(jump.size,),
        scale=sigma,
        reported=False,
    )
    return Effect(
        name=f"jump of {what}",
        title=f"a jump of the reading {what}",
        place=Place.SENSOR,
        parameters=(size,),
        apply=partial(_with_jump, jump),
        trial=jump.trial,
    )


def _with_smoothing(sensor: str, rig: RigParameters, second: float, fourth: float) -> RigParameters:
    one = SmoothedReading(sensor=sensor, second_coefficient=second, fourth_coefficient=fourth)
    return replace(rig, smoothed=(*rig.smoothed, one))


def smoothing_of(log: PreparedLog) -> tuple[Effect, ...]:
    """Nuisance effects for what the filters of smoothed readings leave at low frequencies."""
    sensors = dict.fromkeys(sensor for trial in log.trials for sensor in trial.smoothed_above_hz)
    return tuple(
        Effect(
            name=f"smoothing of {sensor}",
            title=f"the filter by which {sensor} was smoothed",
            place=Place.SENSOR,
            parameters=(_COEFFICIENT, replace(_COEFFICIENT, name="fourth")),
            apply=partial(_with_smoothing, sensor),
            needs=sensor,
        )
        for sensor in sensors
    )


def nuisance_of(log: PreparedLog) -> tuple[Effect, ...]:
    """All nuisance effects of a log."""
    sliding = [trial for trial in log.trials if trial.slides]
    growing = [trial.schedule.mesh is not Mesh.EULERIAN for trial in sliding]
    slips = [SLIP_CONSTANT_DEPTH] if not all(growing) else []
    slips += [SLIP_GROWING_DEPTH] if any(growing) else []
    return (*(LIBRARY[name] for name in SCATTER), *slips, *smoothing_of(log), *late_starts_of(log))
