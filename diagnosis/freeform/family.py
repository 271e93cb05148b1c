"""A family of free-form laws: its place, the variable that it depends on, its coordinates in a fit."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import ArrayLike

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.freeform.smooth_curve import SmoothCurve

Points = tuple[ArrayLike, ArrayLike]
"""A curve by points: x, and y at each."""
KINDS = STRAIGHT, REST, DETAIL = "straight", "rest", "detail"
"""Parts of a curve, by the names of their coordinates."""
VISCOUS = "N mm s / rad / mm"
"""Unit of damping along the shaft: laws in it multiply the damping of the tissue."""
TRIALS = "number of the trial"
"""Unit of what a law with a value for each trial is over."""
FARTHEST = 12.0  # of a coordinate, in its prior's first guess
FINE = 0.3  # of the largest change of a curve by a coordinate of its rest


@dataclass(frozen=True, kw_only=True, eq=False)
class Family:
    """A family of laws with hardly any assumption on their form.

    Attributes:
      effect: the effect that is fitted; its name identifies the family.
      places: where the cause of such a law may be, with probabilities.
      says: variable of the vocabulary that the law depends on.
      title: the quantity that the law gives, in plain words.
      curve: x and y of the law for parameter values, in `x_unit` and `unit`.
      as_effect: values of its parameters with which it is an effect of the library, given those of the
        effect, by its name.
      contains: effects of the library that it may have for a part.
      shape: name of the plain law that its curve has; empty: a curve of any form.
      factor: what its law is multiplied by, over another variable: the same effect, told by its own
        curve; None: nothing.
      multiplies: whether it is such a factor.
    """

    effect: Effect
    places: Mapping[Place, float]
    says: str
    title: str
    curve: Callable[..., Points]
    x_unit: str
    unit: str
    as_effect: Mapping[str, Callable[..., tuple[float, ...]]] = field(default_factory=dict)
    contains: tuple[str, ...] = ()
    shape: str = ""
    factor: "Family | None" = None
    multiplies: bool = False

    @property
    def name(self) -> str:
        """Name of its effect."""
        return self.effect.name

    @property
    def curves(self) -> tuple["Family", ...]:
        """All curves that tell its law: its own, and that of its factor."""
        return (self,) if self.factor is None else (self, self.factor)

    @property
    def of_each_trial(self) -> bool:
        """Whether each trial has coordinates of its own, of which no other trial tells."""
        return any(p.of_one_trial for p in self.effect.parameters)

    @property
    def place(self) -> Place:
        """The most probable place of the cause."""
        return most_probable(self.places)

    def with_prior(self, sigma_of: Mapping[str, float]) -> "Family":
        """The same family with other standard deviations of the priors on its coordinates, by kind."""
        changed = tuple(
            replace(p, prior_sigma=sigma_of.get(kind_of(p), p.prior_sigma))
            for p in self.effect.parameters
        )
        return replace(self, effect=replace(self.effect, parameters=changed))


def most_probable(places: Mapping[Place, float]) -> Place:
    """The place of the highest probability; of several the first."""
    return max(places, key=lambda place: places[place])


def coordinates(
    straight: int, rest: int, scale: float = 1.0, *, detail: int = 0
) -> tuple[Parameter, ...]:
    """Coordinates of a smooth curve, with a first prior of standard deviation `scale`."""
    bound = FARTHEST * scale
    counts = zip(KINDS, (straight, rest, detail), strict=True)
    names = [f"{kind} {i}" for kind, count in counts for i in range(count)]
    return tuple(
        Parameter(
            name=name, unit="-", low=-bound, high=bound, start=(0.0,), scale=scale, prior_sigma=1.0
        )
        for name in names
    )


def coordinates_of(curve: SmoothCurve, scale: float = 1.0) -> tuple[Parameter, ...]:
    """Coordinates of a curve."""
    rest = slice(curve.straight, curve.size - curve.detail)
    own = coordinates(curve.straight, rest.stop - rest.start, scale, detail=curve.detail)
    sizes = np.linalg.norm(curve.basis[:, rest], axis=0)
    fine = np.zeros(curve.size, bool)
    fine[rest] = sizes < FINE * sizes.max(initial=0.0)
    return tuple(replace(p, fine=bool(one)) for p, one in zip(own, fine, strict=True))


def from_neutral(own: Sequence[Parameter], beside: Parameter) -> tuple[Parameter, ...]:
    """Coordinates with as many starts as another parameter has, all of them 0."""
    return tuple(replace(p, start=(0.0,) * len(beside.start)) for p in own)


def of_trials(count: int, scale: float = 1.0) -> tuple[Parameter, ...]:
    """Coordinates that concern one trial each, with a first prior of standard deviation `scale`."""
    return tuple(replace(p, of_one_trial=True) for p in coordinates(0, count, scale))


def kind_of(parameter: Parameter) -> str:
    """The part of a curve that a parameter is a coordinate of; empty: none."""
    word = parameter.name.split()[0]
    return word if word in KINDS else ""
