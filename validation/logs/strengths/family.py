"""Draws of an effect: a range of its strength and, per draw, a map from strength to parameters.

Signs, shapes and phases are drawn before the strength. The signature grows with the strength.
"""

from collections.abc import Callable
from dataclasses import dataclass

from numpy import exp
from numpy.random import Generator

ByStrength = Callable[[float], dict[str, float]]


@dataclass(frozen=True, kw_only=True)
class StrengthFamily:
    """Smallest and largest strength, and the draw of all other parameters."""

    low: float
    high: float
    draw: Callable[[Generator], ByStrength]


def only(name: str) -> Callable[[Generator], ByStrength]:
    """The strength is that parameter, which is the only one."""
    return lambda rng: lambda strength: {name: strength}


def inverse(name: str) -> Callable[[Generator], ByStrength]:
    """The strength is 1 over that parameter."""
    return lambda rng: lambda strength: {name: 1 / strength}


def signed(name: str) -> Callable[[Generator], ByStrength]:
    """The strength is the magnitude of that parameter, of either sign."""

    def draw(rng: Generator) -> ByStrength:
        sign = rng.choice([-1.0, 1.0])
        return lambda strength: {name: sign * strength}

    return draw


def factor(name: str) -> Callable[[Generator], ByStrength]:
    """The strength is the magnitude of the logarithm of that parameter, of either sign."""

    def draw(rng: Generator) -> ByStrength:
        sign = rng.choice([-1.0, 1.0])
        return lambda strength: {name: float(exp(sign * strength))}

    return draw


def with_others(name: str, **others: tuple[float, float]) -> Callable[[Generator], ByStrength]:
    """The strength is that parameter; the others are drawn uniformly from their ranges."""

    def draw(rng: Generator) -> ByStrength:
        drawn = {other: rng.uniform(*ends) for other, ends in others.items()}
        return lambda strength: {name: strength, **drawn}

    return draw


def periodic(name: str, cycles: str, few: int, many: int) -> Callable[[Generator], ByStrength]:
    """The strength is that parameter; with whole cycles per turn, at any phase."""

    def draw(rng: Generator) -> ByStrength:
        drawn = {cycles: float(rng.integers(few, many + 1)), "phase": rng.uniform(-180, 180)}
        return lambda strength: {name: strength, **drawn}

    return draw
