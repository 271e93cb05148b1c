"""A hypothesis about the published rig, as a vector that a fit can vary.

Logarithmic parameters enter by their logarithm, others as a share of their range.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from diagnosis.effects.effect import Parameter
from studies.published.experiments.rig import WITH_FREE_LENGTH, PublishedRig
from studies.published.fitting.mechanisms import (
    DAMPING,
    FREE_LENGTH,
    OF_GELATIN,
    OF_PLASTISOL,
    Mechanism,
)

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class Hypothesis:
    """Mechanisms in a stated rig.

    Attributes:
      names: names of the mechanisms in question.
      base: the rig without them.
      mechanisms: these mechanisms, and the damping if it is fitted with them.
    """

    names: tuple[str, ...]
    base: PublishedRig
    mechanisms: tuple[Mechanism, ...]

    @property
    def free_length(self) -> str:
        """The free length of the quick turn, in words."""
        if FREE_LENGTH.name in self.names:
            return "free length fitted"
        return f"{self.base.free_mm:g} mm free" if self.base.free_mm else "no free length"

    @property
    def parameters(self) -> tuple[Parameter, ...]:
        """Parameters of all mechanisms, in order."""
        return tuple(p for m in self.mechanisms for p in m.parameters)

    def bounds(self) -> tuple[Array, Array]:
        """Lowest and highest vector, (k,) each."""
        low = np.array([_to_fit_units(p, p.low) for p in self.parameters])
        return low, np.array([_to_fit_units(p, p.high) for p in self.parameters])

    def starts(self) -> list[Array]:
        """Starting vectors of fits, (k,) each: as many as the mechanism with the most starts has."""
        count = max((len(p.start) for p in self.parameters), default=1)
        return [
            np.array([_to_fit_units(p, p.start[i % len(p.start)]) for p in self.parameters])
            for i in range(count)
        ]

    def values(self, x: Array) -> list[float]:
        """Parameter values of a vector, in the parameters' units."""
        return [_from_fit_units(p, float(v)) for p, v in zip(self.parameters, x, strict=True)]

    def rig(self, x: Array) -> PublishedRig:
        """The rig with these mechanisms in it."""
        rig, values = self.base, self.values(x)
        for mechanism in self.mechanisms:
            count = len(mechanism.parameters)
            rig = mechanism.apply(rig, *values[:count])
            values = values[count:]
        return rig


def stated(base: PublishedRig) -> Hypothesis:
    """The rig as stated, with nothing fitted."""
    return Hypothesis(names=(), base=base, mechanisms=())


def of_plastisol(base: PublishedRig, *names: str) -> Hypothesis:
    """Mechanisms by name in one stated rig; the damping is fitted with them."""
    mechanisms = (DAMPING, *(OF_PLASTISOL[n] for n in names if n != DAMPING.name))
    return Hypothesis(names=names, base=base, mechanisms=mechanisms)


def of_gelatin(name: str) -> Hypothesis:
    """One effect in gelatin, with the damping of plastisol, since the paper does not state gelatin's."""
    return Hypothesis(names=(name,), base=WITH_FREE_LENGTH, mechanisms=(OF_GELATIN[name],))


def _to_fit_units(p: Parameter, value: float) -> float:
    return float(np.log(value)) if p.logarithmic else (value - p.low) / (p.high - p.low)


def _from_fit_units(p: Parameter, x: float) -> float:
    return float(np.exp(x)) if p.logarithmic else p.low + x * (p.high - p.low)
