"""How the noise of a sensor is correlated in time, whatever its size: what every model of it can do.

Whitened noise is the noise minus what those before tell of it, / the standard deviation of the rest. It
is linear in the readings: differences of residuals and slopes are whitened like residuals. The sum of
squares of whitened residuals is -2 log(likelihood), up to a constant.
"""

from abc import ABC, abstractmethod
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class Colour(ABC):
    """Correlation in time of one sensor's noise."""

    @property
    @abstractmethod
    def share(self) -> float:
        """Share of the variance that is correlated in time."""

    @property
    @abstractmethod
    def in_words(self) -> str:
        """Over what noise is correlated."""

    @abstractmethod
    def numbers(self) -> dict[str, Any]:
        """What it is made of, as a report has it."""

    @abstractmethod
    def of_means(self, share: float, step_s: float) -> "tuple[float, Colour | None]":
        """Standard deviation of means / that of means of white noise, and their colour; None: white.

        The spectral density at frequency 0 stays.

        Args:
          share: means per reading.
          step_s: of the means.
        """

    def whitened(self, time_s: Array, values: Array) -> Array:
        """Innovations / their standard deviation; noise of variance 1 becomes white noise of variance 1.

        Args:
          time_s: (N,), increasing.
          values: residuals / sigma, (N,) or (N, n).
        """
        return self._of_any_shape(time_s, values, restored=False)[0]

    def uncertainty(self, time_s: Array) -> float:
        """Sum of the logarithms of the variances of samples, given those before them."""
        return self._of_any_shape(time_s, np.zeros((time_s.size, 0)), restored=False)[1]

    def restored(self, time_s: Array, whitened: Array) -> Array:
        """The inverse of `whitened`."""
        return self._of_any_shape(time_s, whitened, restored=True)[0]

    def _of_any_shape(self, time_s: Array, values: Array, *, restored: bool) -> tuple[Array, float]:
        count = int(np.prod(values.shape[1:]))
        columns = np.ascontiguousarray(values.reshape(time_s.size, count), float)
        found, log_variance = self._filtered(time_s, columns, restored=restored)
        return np.asarray(found).reshape(values.shape), float(log_variance)

    @abstractmethod
    def _filtered(self, time_s: Array, columns: Array, *, restored: bool) -> tuple[Array, float]:
        """Innovations of readings, or readings of innovations, (N, n), and the sum of log variances."""
