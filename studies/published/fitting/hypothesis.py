"""A hypothesis on the published rig, as a vector that a fit can move in.

Logarithmic parameters are fitted in their logarithm, others as a share of their range.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from diagnosis.effects.effect import Parameter
from studies.published.experiments.rig import PaperRig
from studies.published.fitting.mechanisms import FREE_LENGTH, Candidate

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class Hypothesis:
    """Candidates in a rig.

    Attributes:
      names: of the candidates that it is about.
      base: the rig without them: a reading of what the paper states.
      candidates: those and what they carry with them (the damping).
    """

    names: tuple[str, ...]
    base: PaperRig
    candidates: tuple[Candidate, ...]

    @property
    def reading(self) -> str:
        """How the hypothesis reads the free length of the quick turn."""
        if FREE_LENGTH.name in self.names:
            return "free length fitted"
        return f"{self.base.free_mm:g} mm free" if self.base.free_mm else "no free length"

    @property
    def parameters(self) -> tuple[Parameter, ...]:
        """Of all candidates, in order."""
        return tuple(p for c in self.candidates for p in c.parameters)

    def bounds(self) -> tuple[Array, Array]:
        """Lowest and highest vector."""
        low = np.array([_forward(p, p.low) for p in self.parameters])
        return low, np.array([_forward(p, p.high) for p in self.parameters])

    def starts(self) -> list[Array]:
        """Where fits start: as many as the candidate with most starts has."""
        count = max((len(p.start) for p in self.parameters), default=1)
        return [
            np.array([_forward(p, p.start[i % len(p.start)]) for p in self.parameters])
            for i in range(count)
        ]

    def values(self, x: Array) -> list[float]:
        """Parameter values of a vector."""
        return [_backward(p, float(v)) for p, v in zip(self.parameters, x, strict=True)]

    def rig(self, x: Array) -> PaperRig:
        """The rig with these candidates in it."""
        rig, values = self.base, self.values(x)
        for candidate in self.candidates:
            count = len(candidate.parameters)
            rig = candidate.enter(rig, *values[:count])
            values = values[count:]
        return rig


def _forward(p: Parameter, value: float) -> float:
    return float(np.log(value)) if p.logarithmic else (value - p.low) / (p.high - p.low)


def _backward(p: Parameter, x: float) -> float:
    return float(np.exp(x)) if p.logarithmic else p.low + x * (p.high - p.low)
