"""What could close the gap: the effects of the library, the free length, the base's motion.

Every candidate carries the damping with it, free over four decades: the stated damping
is itself inferred from Table II, whose slow turn at rest shows anything that resists,
and so has to be inferred anew under every candidate.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace

from diagnosis.effects import LIBRARY
from diagnosis.effects.effect import Effect, Parameter
from studies.published.experiments.rig import BaseMotion, PaperRig, Shape


@dataclass(frozen=True, kw_only=True)
class Candidate:
    """Something that the stated rig may lack.

    Attributes:
      place: where it lives.
      enter: the rig with it, given parameter values in order.
      contains: candidates that this one becomes for some parameters.
    """

    name: str
    place: str
    parameters: tuple[Parameter, ...]
    enter: Callable[..., PaperRig]
    contains: tuple[str, ...] = ()


def _of_library(effect: Effect) -> Candidate:
    return Candidate(
        name=effect.name,
        place=effect.place.value,
        parameters=tuple(map(_both_signs, effect.reported))
        if len(effect.reported) == 1
        else effect.reported,
        enter=lambda rig, *values: replace(rig, model=effect.enter(rig.model, *values)),
        contains=effect.contains,
    )


def _both_signs(p: Parameter) -> Parameter:
    """A parameter that may have either sign starts from both, and from none."""
    return replace(p, start=(*p.start, *(-s for s in p.start), 0.0)) if p.low < 0 else p


DAMPING = Candidate(
    name="damping_error",
    place="parameters",
    parameters=(Parameter(name="scale", unit="-", low=1e-3, high=10.0, start=(1.0,), logarithmic=True),),
    enter=lambda rig, scale: replace(
        rig, model=replace(rig.model, damping_scale=rig.model.damping_scale * scale)
    ),
)
FREE_LENGTH = Candidate(
    name="free_length",
    place="drive",
    # The slow turns had 230 mm; below 1 mm there is none to speak of.
    parameters=(Parameter(name="length", unit="mm", low=1.0, high=230.0, start=(25.0, 5.0)),),
    enter=lambda rig, length: replace(rig, free_mm=length),
)
BASE_RAMP = Candidate(
    name="base_ramp",
    place="drive",
    parameters=(
        Parameter(name="duration", unit="s", low=0.02, high=2.0, start=(0.4, 0.15), logarithmic=True),
    ),
    enter=lambda rig, duration: replace(rig, motion=BaseMotion(shape=Shape.RAMP, time_s=duration)),
)
BASE_SERVO = Candidate(
    name="base_servo",
    place="drive",
    parameters=(
        Parameter(name="time", unit="s", low=0.005, high=0.5, start=(0.1, 0.04), logarithmic=True),
    ),
    enter=lambda rig, time: replace(rig, motion=BaseMotion(shape=Shape.SERVO, time_s=time)),
)

CANDIDATES: dict[str, Candidate] = {
    c.name: c
    for c in (
        FREE_LENGTH,
        BASE_RAMP,
        BASE_SERVO,
        *(_of_library(effect) for name, effect in LIBRARY.items() if name != DAMPING.name),
    )
}
OF_GELATIN: dict[str, Candidate] = {name: _of_library(effect) for name, effect in LIBRARY.items()}
