"""Noise that is correlated from row to row, however far rows are apart.

A digital filter that runs once a row, in a loop that is not even, forgets by rows and not by seconds.
What is known of noise at even steps then holds for rows.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from diagnosis.prepare.noise.colour import Colour

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class ColourOfRows(Colour):
    """Correlation from row to row of one sensor's noise, whatever its size.

    Attributes:
      at_steps: the same for rows that are a step apart.
      step_s: the median step.
    """

    at_steps: Colour
    step_s: float

    @property
    def share(self) -> float:
        """Share of the variance that is correlated."""
        return self.at_steps.share

    @property
    def in_words(self) -> str:
        """Over what noise is correlated, at the median step."""
        return f"{self.at_steps.in_words}, from row to row"

    def numbers(self) -> dict[str, Any]:
        """As that at even steps, with these."""
        return {**self.at_steps.numbers(), "of_rows_s": self.step_s}

    def of_means(self, share: float, step_s: float) -> tuple[float, Colour | None]:
        """Means over windows of time have as many rows on average as at even steps."""
        return self.at_steps.of_means(share, step_s)

    def _filtered(self, time_s: Array, columns: Array, *, restored: bool) -> tuple[Array, float]:
        return self.at_steps._filtered(even_rows(time_s, self.step_s), columns, restored=restored)


def even_rows(time_s: Array, step_s: float) -> Array:
    """Times of rows that were a step apart, s, (N,)."""
    return np.asarray(step_s * np.arange(time_s.size), float)
