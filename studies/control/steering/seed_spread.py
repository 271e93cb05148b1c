"""A result over the seeds of noise: median and range."""

import math
from collections.abc import Sequence
from dataclasses import dataclass


@dataclass(frozen=True, kw_only=True)
class Spread:
    """Median, smallest and largest value over the seeds; NaN if it never happened."""

    median: float
    least: float
    largest: float

    @classmethod
    def of(cls, values: Sequence[float]) -> "Spread":
        """The spread of values; NaN (never) counts as larger than any number."""
        ranked = sorted(math.inf if math.isnan(value) else value for value in values)
        middle = 0.5 * (ranked[(len(ranked) - 1) // 2] + ranked[len(ranked) // 2])
        median, least, largest = (
            value if math.isfinite(value) else math.nan for value in (middle, ranked[0], ranked[-1])
        )
        return cls(median=median, least=least, largest=largest)
