"""Projection of the change by an effect, orthogonal to what the parameters of a fit can compensate."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from diagnosis.fitting.bounded_least_squares import bounded_least_squares
from diagnosis.fitting.fit import Fit

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True, eq=False)
class Reachable:
    """Where the linear model leads.

    Attributes:
      cost: that is left there.
      step: of the vector of the fit, (n,); 0 for what was left out.
      scale: of the difference that was added.
    """

    cost: float
    step: Array
    scale: float


class Projection:
    """Removes from residuals what the parameters of a fit can explain."""

    def __init__(self, base: Fit, name: str) -> None:
        """For a fit and an effect by name; a nuisance effect of that name is left out of the fit."""
        self._kept = np.array([owner != name for owner in base.parameterization.owners], bool)
        self._prior = base.parameterization.weights * base.x
        self._residual = base.residual
        slopes = base.slopes[:, self._kept]
        self._basis, self._root = np.linalg.qr(slopes)
        self._low, self._high = (
            np.asarray(b - base.x)[self._kept] for b in base.parameterization.bounds()
        )

    def beyond(self, by_trial: Sequence[Array]) -> Array:
        """Change of residuals, one array per trial, from those of the fit, minus what it can explain."""
        moved = self._from_fit(by_trial)
        return np.asarray(moved - self._basis @ (self._basis.T @ moved))

    def answered_cost(self, by_trial: Sequence[Array]) -> float:
        """Cost where residuals are these, one array per trial, and the fit answers, bounds aside."""
        there = self._residual + self._from_fit(by_trial)
        beside = there - self._basis @ (self._basis.T @ there)
        return float(beside @ beside)

    def answer(self, by_trial: Sequence[Array]) -> Array:
        """Step of the fit's vector, (n,), with which it answers the same change, bounds aside."""
        step = np.zeros(self._kept.size)
        within = self._basis.T @ self._from_fit(by_trial)
        step[self._kept] = -np.linalg.lstsq(self._root, within, rcond=None)[0]
        return step

    def reachable(self, by_trial: Sequence[Array] | None = None) -> Reachable:
        """What the fit comes to within its bounds, if any positive multiple of a difference is added.

        Args:
          by_trial: residuals with the difference, one array per trial; None: no difference.
        """
        moved = np.zeros_like(self._residual) if by_trial is None else self._from_fit(by_trial)
        within = self._basis.T @ moved
        beside = moved - self._basis @ within
        size = max(float(np.linalg.norm(beside)), 1e-12)
        last = np.append(np.zeros(within.size), size)
        system = np.vstack([np.column_stack([self._root, within]), last])
        seen = np.append(self._basis.T @ self._residual, beside @ self._residual / size)
        step = bounded_least_squares(
            system, -seen, np.append(self._low, 0.0), np.append(self._high, np.inf)
        )
        unseen = float(self._residual @ self._residual - seen @ seen)
        moves = np.zeros(self._kept.size)
        moves[self._kept] = step[:-1]
        cost = unseen + float(np.sum((seen + system @ step) ** 2))
        return Reachable(cost=cost, step=moves, scale=float(step[-1]))

    def _from_fit(self, by_trial: Sequence[Array]) -> Array:
        there = np.concatenate([*by_trial, np.where(self._kept, self._prior, 0.0)])
        return np.asarray(there - self._residual)
