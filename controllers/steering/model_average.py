"""Two fused estimators, one that trusts the base and one that doubts it, averaged by probability.

Images are noisy. A filter that always doubts the base follows their noise even when the base
is right. So the roll is the mean of both filters, weighted by their probabilities given the images
(a bank of Kalman filters; Bar-Shalom, Li and Kirubarajan 2001, 11.6):

    w_i <- w_i * likelihood_i of the image,    then w_i <- (1 - e) w_i + e w_i at the start

The second step keeps every probability above 0: the base may become wrong later.
"""

import math
from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike

from controllers.signals import Estimate, Sample
from controllers.steering.fused import FusedEstimator
from models.errors import InvalidValue

_RETURN = 1e-3  # e: probability with which an image starts the choice anew


class ModelAverage:
    """The weighted mean of a filter that trusts the base and one that does not.

    Args:
      trusting, doubting: two filters that differ only in their assumed noise.
      doubt: probability, before any image, that the base is wrong.

    Attributes:
      doubting_estimate: the last estimate of the filter that doubts.

    Raises:
      InvalidValue: doubt is not between 0 and 1.
    """

    def __init__(
        self, trusting: FusedEstimator, doubting: FusedEstimator, *, doubt: float = 0.1
    ) -> None:
        if not 0.0 < doubt < 1.0:
            raise InvalidValue("doubt", doubt, "a probability above 0 and below 1")
        self.filters = (trusting, doubting)
        self._start = np.array([1.0 - doubt, doubt])
        self.reset()

    def reset(self) -> None:
        """Go back to the state before the first sample, in both filters."""
        for one in self.filters:
            one.reset()
        self._weights = self._start.copy()
        self.doubting_estimate = Estimate(math.nan)

    @property
    def doubt(self) -> float:
        """Probability that the base is wrong, given all images so far."""
        return float(self._weights[1])

    def update(self, sample: Sample) -> Estimate:
        """Take one sample of the base."""
        trusting, doubting = (one.update(sample) for one in self.filters)
        self.doubting_estimate = doubting
        mixed = self._weights @ [trusting.tip_deg, doubting.tip_deg]
        return replace(trusting, tip_deg=float(mixed)) if math.isfinite(mixed) else trusting

    def expose(self) -> None:
        """An image is taken now."""
        for one in self.filters:
            one.expose()

    def see(self, position_mm: ArrayLike) -> None:
        """Correct both by the tip's position, mm, (3,), and weigh them by how well they predicted it."""
        logs = np.array([one.see(position_mm) for one in self.filters])
        posterior = self._weights * np.exp(logs - logs.max())
        posterior /= posterior.sum()
        self._weights = (1.0 - _RETURN) * posterior + _RETURN * self._start
