"""A family of free-form laws: a place, what the law depends on, and coordinates that a fit moves in."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace

from diagnosis.effects.effect import Effect, Parameter, Place

Points = tuple[Sequence[float], Sequence[float]]
"""A curve by points: x, and y at each."""
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

    def with_prior(self, sigma: float) -> "Family":
        """The same, its coordinates with a prior of another strength."""
        return replace(self, effect=with_prior(self.effect, sigma))


def with_prior(effect: Effect, sigma: float) -> Effect:
    """The effect, its coordinates with a prior of another strength."""
    changed = tuple(replace(p, prior_sigma=sigma) if is_coordinate(p) else p for p in effect.parameters)
    return replace(effect, parameters=changed)


def coordinates(count: int, scale: float = 1.0) -> tuple[Parameter, ...]:
    """Of a smooth curve, each with a prior of size `scale` at first."""
    bound = FARTHEST * scale
    return tuple(
        Parameter(
            name=f"c{i}", unit="-", low=-bound, high=bound, start=(0.0,), scale=scale, prior_sigma=1.0
        )
        for i in range(count)
    )


def is_coordinate(parameter: Parameter) -> bool:
    """Whether a parameter is a coordinate of a curve."""
    return parameter.prior_sigma < float("inf")
