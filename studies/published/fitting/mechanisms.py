"""Mechanisms that may explain the residual: the library's effects, the free length, the base's turn.

Every hypothesis on plastisol also fits the damping, over four decades: the stated damping was
inferred from Table II, whose slow turn at rest shows everything that resists, so it has to be
inferred anew with every mechanism.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace

from diagnosis.effects import LIBRARY
from diagnosis.effects.effect import Effect, Parameter
from studies.published.experiments.base_turn import BaseTurn, BaseTurnShape
from studies.published.experiments.rig import PublishedRig


@dataclass(frozen=True, kw_only=True)
class Mechanism:
    """A mechanism that the stated rig may lack.

    Attributes:
      place: the part of the rig where it acts.
      apply: adds it to a rig, given parameter values in order.
      contains: mechanisms that are special cases of this one.
    """

    name: str
    place: str
    parameters: tuple[Parameter, ...]
    apply: Callable[..., PublishedRig]
    contains: tuple[str, ...] = ()


def _of_library(effect: Effect) -> Mechanism:
    return Mechanism(
        name=effect.name,
        place=effect.place.value,
        parameters=tuple(map(_both_signs, effect.reported))
        if len(effect.reported) == 1
        else effect.reported,
        apply=lambda rig, *values: replace(rig, model=effect.apply(rig.model, *values)),
        contains=tuple(effect.contains),
    )


def _both_signs(p: Parameter) -> Parameter:
    """The parameter with starting points of either sign, and zero."""
    return replace(p, start=(*p.start, *(-s for s in p.start), 0.0)) if p.low < 0 else p


DAMPING = Mechanism(
    name="damping_error",
    place="parameters",
    parameters=(Parameter(name="scale", unit="-", low=1e-3, high=10.0, start=(1.0,), logarithmic=True),),
    apply=lambda rig, scale: replace(
        rig, model=replace(rig.model, damping_scale=rig.model.damping_scale * scale)
    ),
)
FREE_LENGTH = Mechanism(
    name="free_length",
    place="drive",
    # Up to the 230 mm of the slow turns; below 1 mm it has no effect on any figure.
    parameters=(Parameter(name="length", unit="mm", low=1.0, high=230.0, start=(25.0, 5.0)),),
    apply=lambda rig, length: replace(rig, free_mm=length),
)
BASE_RAMP = Mechanism(
    name="base_ramp",
    place="drive",
    parameters=(
        Parameter(name="duration", unit="s", low=0.02, high=2.0, start=(0.4, 0.15), logarithmic=True),
    ),
    apply=lambda rig, duration: replace(rig, turn=BaseTurn(shape=BaseTurnShape.RAMP, time_s=duration)),
)
BASE_SERVO = Mechanism(
    name="base_servo",
    place="drive",
    parameters=(
        Parameter(name="time", unit="s", low=0.005, high=0.5, start=(0.1, 0.04), logarithmic=True),
    ),
    apply=lambda rig, time: replace(rig, turn=BaseTurn(shape=BaseTurnShape.SERVO, time_s=time)),
)

NOT_STUDIED = frozenset(
    ("torque_scale", "torque_sensor_delay", "base_angle_scale", "drive_friction", "inserted_offset")
)
"""Effects on the constants of a rig's log: the paper states its gains, and its figures have none."""
_STUDIED = {name: effect for name, effect in LIBRARY.items() if name not in NOT_STUDIED}

OF_PLASTISOL: dict[str, Mechanism] = {
    m.name: m
    for m in (
        FREE_LENGTH,
        BASE_RAMP,
        BASE_SERVO,
        *(_of_library(effect) for name, effect in _STUDIED.items() if name != DAMPING.name),
    )
}
OF_GELATIN: dict[str, Mechanism] = {name: _of_library(effect) for name, effect in _STUDIED.items()}
