"""Fitting hypotheses to published figures.

A fit minimises chi-square, the sum over figures of ((predicted - published) / sigma)^2, by
MuJoCo's own Gauss-Newton method with bounds.
"""

from collections.abc import Sequence

import numpy as np
from mujoco import minimize
from numpy.typing import NDArray

from studies.published import criteria
from studies.published.experiments.measurement import MeasuredFigure
from studies.published.experiments.replay import FigureReplay
from studies.published.fitting.fit import FigureFit
from studies.published.fitting.hypothesis import Hypothesis
from studies.published.fitting.leave_one_out import vector_without

Array = NDArray[np.float64]


class FigureFitter:
    """Fits hypotheses to one set of n figures."""

    def __init__(self, figures: Sequence[MeasuredFigure], replay: FigureReplay) -> None:
        self.figures, self._replay = tuple(figures), replay

    def residual(self, hypothesis: Hypothesis, columns: Array) -> Array:
        """Residuals of M vectors, (k, M), in standard deviations, (n, M)."""
        predicted = self._replay(self.figures, [hypothesis.rig(x) for x in columns.T])
        published = np.array([[f.value] for f in self.figures])
        sigma = np.array([[f.sigma] for f in self.figures])
        return np.asarray((predicted - published) / sigma, np.float64)

    def minimum(
        self,
        hypothesis: Hypothesis,
        starts: Sequence[Array] = (),
        *,
        iterations: int = criteria.FIT_ITERATIONS,
    ) -> Array:
        """The vector of smallest chi-square, (k,).

        Args:
          starts: vectors; the search starts from the best of them. Without any: the starts of the
            mechanisms' parameters.
        """
        low, high = hypothesis.bounds()
        if not low.size:
            return low
        columns = np.stack([np.clip(s, low, high) for s in starts or hypothesis.starts()], axis=-1)
        chi_squares = (self.residual(hypothesis, columns) ** 2).sum(axis=0)

        def residual(x: Array) -> Array:
            return self.residual(hypothesis, x.reshape(x.shape[0], -1)).reshape(-1, *x.shape[1:])

        x, _ = minimize.least_squares(
            columns[:, int(np.argmin(chi_squares))],
            residual,
            bounds=[low, high],
            eps=criteria.DIFFERENCE,
            max_iter=iterations,
            mu_min=1e-3,
            mu_factor=8.0,
            gtol=criteria.GRADIENT_TOLERANCE,
            xtol=criteria.MOVE_TOLERANCE,
            verbose=minimize.Verbosity.SILENT,
        )
        return np.asarray(x, np.float64).ravel()

    def fit(self, hypothesis: Hypothesis, starts: Sequence[Array] = ()) -> FigureFit:
        """Fit a hypothesis, and predict each figure from a fit to the others."""
        x = self.minimum(hypothesis, starts)
        residual, jacobian = self._linearised(hypothesis, x)
        return FigureFit(
            hypothesis=hypothesis,
            figures=self.figures,
            x=x,
            residual=residual,
            jacobian=jacobian,
            left_out=self._left_out(hypothesis, x, residual, jacobian),
        )

    def _linearised(self, hypothesis: Hypothesis, x: Array) -> tuple[Array, Array]:
        """Residual (n,) and its Jacobian (n, k) at a vector."""
        _, high = hypothesis.bounds()
        steps = criteria.DIFFERENCE * np.where(x + criteria.DIFFERENCE > high, -1.0, 1.0)
        columns = np.concatenate([x[:, None], x[:, None] + np.diag(steps)], axis=1)
        around = self.residual(hypothesis, columns)
        return around[:, 0], (around[:, 1:] - around[:, :1]) / steps

    def _left_out(self, hypothesis: Hypothesis, x: Array, residual: Array, jacobian: Array) -> Array:
        """Residual of each figure, predicted from a fit to the others, (n,)."""
        left_out = residual.copy()
        for i, figure in enumerate(self.figures if x.size else ()):
            moved = vector_without(i, x, residual, jacobian, hypothesis.bounds())
            left_out[i] = FigureFitter((figure,), self._replay).residual(hypothesis, moved[:, None])[
                0, 0
            ]
        return left_out
