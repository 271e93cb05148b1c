"""Noise of a sensor that is not of one size: its samples count by what their own noise is."""

from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from diagnosis.prepare.prepared_log import PreparedTrial

Array = NDArray[np.float64]


class VaryingNoise(Protocol):
    """How the noise of a sensor varies over a log."""

    @property
    def noise_ratio(self) -> float:
        """Root mean square of the noise / what it was taken for."""
        ...

    @property
    def in_words(self) -> str:
        """How, and how much, after "the noise"."""
        ...

    def sizes(self, trial: PreparedTrial) -> Array:
        """Noise at every sample / its root mean square over the log, (N,)."""
        ...
