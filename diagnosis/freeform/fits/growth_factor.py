"""A law that grows: what it adds is multiplied by a factor over another variable,

    angle, reading or torque += f(x) (1 + g(z)),

as play that wears, ripple that comes with the rate, or an error of a sensor that comes with the depth.
In a fit of trial after trial the factor may be a number of each trial.
"""

from collections.abc import Sequence
from dataclasses import replace
from functools import partial

import numpy as np

from diagnosis.effects.effect import Parameter
from diagnosis.freeform.family import TRIALS, Family, Points, coordinates_of, of_trials
from diagnosis.freeform.ranges import LogRanges
from diagnosis.freeform.smooth_curve import SmoothCurve, bent_curve
from diagnosis.replay.curve import FACTORS, ActsOn, Course, Curve
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.replay.variables import SAYS, UNITS, Variable

VARIABLES = (Variable.TIME, Variable.HISTORY, Variable.DEPTH, Variable.AXIAL_SPEED, Variable.RATE)
_PLACES = 6
_OF_TRIALS = "trial by trial"


def may_grow(free: FreeLaw | None) -> bool:
    """Whether a law adds curves to angles, readings and torques, and nothing else."""
    if free is None or not free.curves or replace(free, curves=()) != FreeLaw():
        return False
    return all(map(_may_grow, free.curves))


def _may_grow(curve: Curve) -> bool:
    multiplies = curve.acts_on in (*FACTORS, ActsOn.ORIENTATION)
    return not (multiplies or curve.trial or curve.factor or curve.variable is Variable.LAG)


def all_grown(family: Family, ranges: LogRanges) -> tuple[Family, ...]:
    """The family with a factor over each variable of the log but its own, and trial by trial."""
    others = (v for v in VARIABLES if v in ranges.ends and SAYS.get(v, v) != family.says)
    over = [grown_over(family, v, *ranges.ends[v]) for v in others]
    trials = tuple(trial.name for trial in ranges.problem.log.trials)
    return (*over, grown_in_trials(family, trials)) if len(trials) > 1 else tuple(over)


def grown_over(family: Family, variable: Variable, low: float, high: float) -> Family:
    """The family times 1 + a curve over a variable between two ends."""
    curve = _without_level(bent_curve(low, high, _PLACES))
    return _grown(
        family,
        coordinates_of(curve),
        partial(_apply_over, family, variable, curve),
        by=str(variable),
        says=SAYS.get(variable, variable),
        curve=partial(_factor_over, family, curve),
        x_unit=UNITS[variable],
    )


def grown_in_trials(family: Family, trials: Sequence[str]) -> Family:
    """The family times 1 + a number of each trial."""
    return _grown(
        family,
        of_trials(len(trials)),
        partial(_apply_in_trials, family, tuple(trials)),
        by=_OF_TRIALS,
        says="time",
        curve=partial(_factor_in_trials, family),
        x_unit=TRIALS,
    )


def _grown(
    family: Family,
    more: tuple[Parameter, ...],
    apply: partial[RigParameters],
    *,
    by: str,
    says: str,
    curve: partial[Points],
    x_unit: str,
) -> Family:
    name = f"{family.name}, growing with {by}" if by != _OF_TRIALS else f"{family.name}, growing {by}"
    starts = len(family.effect.parameters[0].start)
    parameters = (
        *family.effect.parameters,
        *(replace(p, name=f"{p.name} of the factor", start=starts * p.start) for p in more),
    )
    effect = replace(family.effect, name=name, title=name, parameters=parameters, apply=apply)
    own = replace(
        family,
        effect=effect,
        curve=partial(_of_law, family),
        as_effect={},
        contains=(),
    )
    factor = replace(
        own,
        says=says,
        title=f"factor of the {family.title}",
        curve=curve,
        x_unit=x_unit,
        unit="-",
        multiplies=True,
    )
    return replace(own, factor=factor)


def _without_level(curve: SmoothCurve) -> SmoothCurve:
    """A curve without its constant, which the law has for its size."""
    return replace(curve, basis=curve.basis[:, 1:], straight=curve.straight - 1)


def _split(family: Family, values: Sequence[float]) -> tuple[Sequence[float], Sequence[float]]:
    size = len(family.effect.parameters)
    return values[:size], values[size:]


def _of_law(family: Family, *values: float) -> Points:
    return family.curve(*_split(family, values)[0])


def _factor_over(family: Family, curve: SmoothCurve, *values: float) -> Points:
    return curve.places, 1.0 + np.array(curve.values(_split(family, values)[1]))


def _factor_in_trials(family: Family, *values: float) -> Points:
    own = np.array(_split(family, values)[1])
    return np.arange(1, own.size + 1), 1.0 + own


def _apply_over(
    family: Family, variable: Variable, curve: SmoothCurve, rig: RigParameters, *values: float
) -> RigParameters:
    places, factors = _factor_over(family, curve, *values)
    course = Course(variable=variable, places=_numbers(places), values=_numbers(factors))
    free = _law(family, rig, values)
    curves = tuple(replace(own, factor=course) for own in free.curves)
    return replace(rig, free=FreeLaw(curves=curves))


def _apply_in_trials(
    family: Family, trials: Sequence[str], rig: RigParameters, *values: float
) -> RigParameters:
    factors = _numbers(_factor_in_trials(family, *values)[1])
    free = _law(family, rig, values)
    each = zip(trials, factors, strict=True)
    curves = tuple(replace(c.times(f), trial=trial) for trial, f in each for c in free.curves)
    return replace(rig, free=FreeLaw(curves=curves))


def _law(family: Family, rig: RigParameters, values: Sequence[float]) -> FreeLaw:
    return family.effect.apply(rig, *_split(family, values)[0]).free or FreeLaw()


def _numbers(values: object) -> tuple[float, ...]:
    return tuple(float(v) for v in np.asarray(values, float))
