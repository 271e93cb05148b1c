"""A hypothesis fitted to published figures, and the measures of its fit.

p       probability of a chi-square at least as large, with (figures - parameters) degrees of freedom
AICc    chi-square + 2 k + 2 k (k + 1) / (n - k - 1): the penalty on k parameters rises
        without bound as k approaches the n figures (Hurvich and Tsai, 1989)
rms     root mean square residual, in standard deviations, of the figures of the fit and of
        each figure left out in turn
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.stats import chi2, t

from studies.published.criteria import INTERVAL, LEAST_SENSITIVITY
from studies.published.experiments.measurement import MeasuredFigure
from studies.published.fitting.hypothesis import Hypothesis

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True, eq=False)
class FigureFit:
    """A hypothesis fitted to figures: k parameters, n figures.

    Attributes:
      x: the fitted vector, (k,).
      residual: (predicted - published) / sigma, (n,).
      jacobian: d residual / d x, (n, k).
      left_out: residual of each figure, predicted by a fit to the others, (n,).
    """

    hypothesis: Hypothesis
    figures: tuple[MeasuredFigure, ...]
    x: Array
    residual: Array
    jacobian: Array
    left_out: Array

    @property
    def predicted(self) -> Array:
        """Predicted figures in their units, (n,)."""
        published = np.array([f.value for f in self.figures])
        return np.asarray(published + self.residual * [f.sigma for f in self.figures], np.float64)

    @property
    def chi_square(self) -> float:
        """Sum of squared residuals."""
        return float(self.residual @ self.residual)

    @property
    def degrees_of_freedom(self) -> int:
        """Figures minus parameters."""
        return self.residual.size - self.x.size

    @property
    def p_value(self) -> float:
        """Probability of a chi-square as large; 0 where no degree of freedom is left."""
        return chi_square_p_value(self.chi_square, self.degrees_of_freedom)

    @property
    def aicc(self) -> float:
        """Chi-square and the penalty on the parameters; infinite where n - k < 2."""
        k, left = self.x.size, self.degrees_of_freedom - 1
        return self.chi_square + 2 * k + 2 * k * (k + 1) / left if left > 0 else float("inf")

    @property
    def rms_residual(self) -> float:
        """Root mean square residual, in standard deviations."""
        return rms(self.residual)

    @property
    def rms_left_out(self) -> float:
        """Root mean square residual of each figure left out in turn, in standard deviations."""
        return rms(self.left_out)

    def intervals(self) -> list[tuple[float, float, float]]:
        """Value, low and high of a 95 % interval of every parameter, in order.

        Linearised, with Student's t; if chi-square exceeds its degrees of freedom, the intervals are
        scaled up accordingly (Birge ratio).
        """
        low, high = self.hypothesis.bounds()
        if self.degrees_of_freedom <= 0:
            ends = [low, high]
        else:
            half = self._half_widths()
            ends = [np.clip(self.x - half, low, high), np.clip(self.x + half, low, high)]
        return list(zip(*(self.hypothesis.values(x) for x in (self.x, *ends)), strict=True))

    def _half_widths(self) -> Array:
        covariance = np.linalg.pinv(self.jacobian.T @ self.jacobian)
        birge = max(1.0, self.chi_square / self.degrees_of_freedom)
        quantile = t.ppf((1 + INTERVAL) / 2, self.degrees_of_freedom)
        half = quantile * np.sqrt(birge * np.diag(covariance))
        # A parameter that no figure shows has its whole range as interval.
        return np.where((self.jacobian**2).sum(axis=0) > LEAST_SENSITIVITY, half, np.inf)


def chi_square_p_value(chi_square: float, degrees_of_freedom: int) -> float:
    """Probability of a chi-square as large; 0 where no degree of freedom is left."""
    return float(chi2.sf(chi_square, degrees_of_freedom)) if degrees_of_freedom > 0 else 0.0


def parameter_penalty(figures: int) -> dict[int, float]:
    """Penalty of AICc for k parameters fitted to so many figures, by k, as far as it is finite."""
    return {k: 2 * k + 2 * k * (k + 1) / (figures - k - 1) for k in range(1, figures - 1)}


def rms(values: Array) -> float:
    """Root mean square."""
    return float(np.sqrt(np.mean(np.square(values))))
