"""Fitting a hypothesis to published figures, and what it predicts of those left out.

Minimised is chi-square, the sum over figures of ((predicted - published) / spread)^2, by
MuJoCo's own box-bounded Gauss-Newton. Fits of so few figures are judged by

    p       chance of a chi-square as large with figures - parameters degrees of freedom
    AICc    chi-square + 2 k + 2 k (k + 1) / (n - k - 1): the price of k parameters rises
            without bound as k comes near the n figures (Hurvich and Tsai, 1989)
    gap     root mean square of the misses, in spreads, on the figures of the fit and on
            each figure left out in turn
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from mujoco import minimize
from numpy.typing import NDArray
from scipy.optimize import lsq_linear
from scipy.stats import chi2, t

from studies.published.experiments.figures import Figure
from studies.published.experiments.replay import Replay
from studies.published.fitting.hypothesis import Hypothesis

Array = NDArray[np.float64]

_STEP = 1e-3  # of finite differences, in the units of the fit
_MOST_ITERATIONS = 8
_GRADIENT, _MOVE = 0.03, 2e-3  # at which a fit ends: hundredths of a spread
# Farther than this one linear step says nothing: e-fold, or the whole range.
_LONGEST_STEP = 1.0


@dataclass(frozen=True, kw_only=True, eq=False)
class Fit:
    """A hypothesis fitted to figures: k parameters, n figures.

    Attributes:
      x: the vector, (k,).
      missed: (predicted - published) / spread, (n,).
      jacobian: d missed / d x, (n, k).
      left_out: the same misses, each predicted by a fit to the other figures, (n,).
    """

    hypothesis: Hypothesis
    figures: tuple[Figure, ...]
    x: Array
    missed: Array
    jacobian: Array
    left_out: Array

    @property
    def predicted(self) -> Array:
        """Figures in their units, (n,)."""
        published = np.array([f.value for f in self.figures])
        return np.asarray(published + self.missed * [f.spread for f in self.figures], np.float64)

    @property
    def chi_square(self) -> float:
        """Sum of squared misses."""
        return float(self.missed @ self.missed)

    @property
    def freedom(self) -> int:
        """Figures less parameters."""
        return self.missed.size - self.x.size

    @property
    def p_value(self) -> float:
        """Chance of a chi-square as large; 0 where nothing is left to test it."""
        return float(chi2.sf(self.chi_square, self.freedom)) if self.freedom > 0 else 0.0

    @property
    def aicc(self) -> float:
        """Chi-square and the price of the parameters; infinite where n - k < 2."""
        k, left = self.x.size, self.freedom - 1
        return self.chi_square + 2 * k + 2 * k * (k + 1) / left if left > 0 else float("inf")

    @property
    def gap(self) -> float:
        """Root mean square miss, in spreads."""
        return rms(self.missed)

    def intervals(self) -> list[tuple[float, float, float]]:
        """Value, low and high of a 95 % interval of every parameter, in order.

        Linear, with Student's t; a fit that misses by more than the spreads has them
        widened by as much (Birge).
        """
        low, high = self.hypothesis.bounds()
        if self.freedom <= 0:
            ends = [low, high]
        else:
            covariance = np.linalg.pinv(self.jacobian.T @ self.jacobian)
            widened = max(1.0, self.chi_square / self.freedom)
            reach = t.ppf(0.975, self.freedom) * np.sqrt(widened * np.diag(covariance))
            # A figure-blind direction has no curvature at all: its interval is the range.
            reach = np.where((self.jacobian**2).sum(axis=0) > 1e-12, reach, np.inf)
            ends = [np.clip(self.x - reach, low, high), np.clip(self.x + reach, low, high)]
        return list(zip(*(self.hypothesis.values(x) for x in (self.x, *ends)), strict=True))


def rms(values: Array) -> float:
    """Root mean square."""
    return float(np.sqrt(np.mean(np.square(values))))


class Fitter:
    """Fits hypotheses to one set of figures."""

    def __init__(self, figures: Sequence[Figure], replay: Replay) -> None:
        self.figures, self._replay = tuple(figures), replay

    def missed(self, hypothesis: Hypothesis, columns: Array) -> Array:
        """Misses of every column, (k, M) to (n, M), in spreads."""
        predicted = self._replay(self.figures, [hypothesis.rig(x) for x in columns.T])
        published = np.array([[f.value] for f in self.figures])
        spread = np.array([[f.spread] for f in self.figures])
        return np.asarray((predicted - published) / spread, np.float64)

    def nearest(
        self, hypothesis: Hypothesis, starts: Sequence[Array] = (), *, iterations: int = _MOST_ITERATIONS
    ) -> Array:
        """The vector of least chi-square, (k,).

        Args:
          starts: where to start; none: where the candidates' parameters do. The best of
            them is gone on from.
        """
        low, high = hypothesis.bounds()
        if not low.size:
            return low
        columns = np.stack([np.clip(s, low, high) for s in starts or hypothesis.starts()], axis=-1)
        costs = (self.missed(hypothesis, columns) ** 2).sum(axis=0)

        def residual(x: Array) -> Array:
            return self.missed(hypothesis, x.reshape(x.shape[0], -1)).reshape(-1, *x.shape[1:])

        x, _ = minimize.least_squares(
            columns[:, int(np.argmin(costs))],
            residual,
            bounds=[low, high],
            eps=_STEP,
            max_iter=iterations,
            mu_min=1e-3,
            mu_factor=8.0,
            gtol=_GRADIENT,
            xtol=_MOVE,
            verbose=minimize.Verbosity.SILENT,
        )
        return np.asarray(x, np.float64).ravel()

    def fit(self, hypothesis: Hypothesis, starts: Sequence[Array] = ()) -> Fit:
        """Fit a hypothesis, and predict each figure from a fit to the others."""
        x = self.nearest(hypothesis, starts)
        low, high = hypothesis.bounds()
        steps = _STEP * np.where(x + _STEP > high, -1.0, 1.0)
        columns = np.concatenate([x[:, None], x[:, None] + np.diag(steps)], axis=1)
        around = self.missed(hypothesis, columns)
        missed, jacobian = around[:, 0], (around[:, 1:] - around[:, :1]) / steps
        left_out = missed.copy()
        for i, figure in enumerate(self.figures if x.size else ()):
            moved = _without(i, x, missed, jacobian, low, high)
            left_out[i] = Fitter((figure,), self._replay).missed(hypothesis, moved[:, None])[0, 0]
        return Fit(
            hypothesis=hypothesis,
            figures=self.figures,
            x=x,
            missed=missed,
            jacobian=jacobian,
            left_out=left_out,
        )


def _without(i: int, x: Array, missed: Array, jacobian: Array, low: Array, high: Array) -> Array:
    """The vector after one Gauss-Newton step on all figures but one, within bounds."""
    others = np.arange(missed.size) != i
    room = (
        np.minimum(np.maximum(low - x, -_LONGEST_STEP), -1e-12),
        np.maximum(np.minimum(high - x, _LONGEST_STEP), 1e-12),
    )
    step = lsq_linear(jacobian[others], -missed[others], bounds=room).x
    return np.asarray(np.clip(x + step, low, high), np.float64)
