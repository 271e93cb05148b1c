"""A family of free-form laws: a place, what the law depends on, and coordinates that a fit moves in."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace

from numpy.typing import ArrayLike

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.freeform.smooth_curve import SmoothCurve

Points = tuple[ArrayLike, ArrayLike]
"""A curve by points: x, and y at each."""
_STRAIGHT, _REST = "straight", "rest"
FARTHEST = 12.0  # of a coordinate, in its prior's first guess


@dataclass(frozen=True, kw_only=True, eq=False)
class Family:
    """Laws that assume next to nothing.

    Attributes:
      effect: what a fit moves; its name tells the families apart.
      places: where what it stands for may live, with how likely that is of it.
      says: variable of the vocabulary that the law depends on.
      title: of the law, in plain words, as what grows or falls.
      curve: x and y of the law for parameter values, in `unit`.
      x_unit, unit: of the curve.
    """

    effect: Effect
    places: Mapping[Place, float]
    says: str
    title: str
    curve: Callable[..., Points]
    x_unit: str
    unit: str

    @property
    def name(self) -> str:
        """Of its effect."""
        return self.effect.name

    @property
    def place(self) -> Place:
        """Where what it stands for most likely lives."""
        return max(self.places, key=lambda place: self.places[place])

    def with_prior(self, straight: float, rest: float) -> "Family":
        """The same, its coordinates with priors of other strengths."""
        each = {_STRAIGHT: straight, _REST: rest}
        changed = tuple(
            replace(p, prior_sigma=each[kind_of(p)]) if kind_of(p) else p for p in self.effect.parameters
        )
        return replace(self, effect=replace(self.effect, parameters=changed))


def coordinates(straight: int, rest: int, scale: float = 1.0) -> tuple[Parameter, ...]:
    """Of a smooth curve, each with a prior of size `scale` at first."""
    bound = FARTHEST * scale
    names = [f"{_STRAIGHT} {i}" for i in range(straight)] + [f"{_REST} {i}" for i in range(rest)]
    return tuple(
        Parameter(
            name=name, unit="-", low=-bound, high=bound, start=(0.0,), scale=scale, prior_sigma=1.0
        )
        for name in names
    )


def coordinates_of(curve: SmoothCurve, scale: float = 1.0) -> tuple[Parameter, ...]:
    """Of a curve."""
    return coordinates(curve.straight, curve.size - curve.straight, scale)


def kind_of(parameter: Parameter) -> str:
    """Which part of a curve a parameter is a coordinate of; empty: it is none."""
    word = parameter.name.split()[0]
    return word if word in (_STRAIGHT, _REST) else ""
