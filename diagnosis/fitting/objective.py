"""Residuals of a log as a function of the fit's vector, and their slopes.

Nuisance parameters move by a few per cent at most: their slopes are computed again only if the
effects have moved far. The pasts of late trials move as far as effects do, but cost one trial only.
In fits that only tell which to do again, all slopes hold for one step more where they foretold the last
one: they learn what they missed of it, row by row,

    J + (dr - J dx) dx' / |dx|^2,       dx without the entries that the row has no slope along

(Broyden, Mathematics of Computation 19, 1965; Schubert, same 24, 1970).

Iterations of a fit run the callback alone, which takes the same steps; MuJoCo simulates the end of
those on the log itself.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from diagnosis.fitting.parameterization import Parameterization
from diagnosis.fitting.problem import FitProblem
from diagnosis.stopping import raise_if_stopped
from sim.needles.run import SimulationFailed

Array = NDArray[np.float64]

_FAR = 0.1  # of the effects' entries, after which the slopes of the nuisance are taken again
_NEAR = 0.02  # of all entries, within which the slopes are the same for one more step
_MISSED = 0.3  # of a change of the residuals, up to which slopes foretold it
_KEPT = 16  # vectors whose residuals are kept: more than a search along one direction takes


@dataclass(frozen=True, kw_only=True, eq=False)
class NearStart:
    """What another fit says about the start of a fit.

    One without the effects says what the slopes along the nuisance are; one that ended there, all.

    Attributes:
      slopes: along the last k entries of the vector, without the prior, (N, k).
      by_trial: residuals / sigma, if they are the same at the start; None: they may differ.
    """

    slopes: Array
    by_trial: tuple[Array, ...] | None


class Objective:
    """For `mujoco.minimize`: callable, with a Jacobian by finite differences.

    Attributes:
      difference: step of the finite differences, in the units of the fit.
      slopes: the last Jacobian, (N, n).
    """

    def __init__(
        self,
        problem: FitProblem,
        parameterization: Parameterization,
        difference: float = 1e-3,
        slopes: Array | None = None,
    ) -> None:
        """An objective.

        Args:
          slopes: a known Jacobian, (N, n), that is used everywhere; None: it is computed.
        """
        self.problem, self.parameterization = problem, parameterization
        self._of_differences = problem.of_differences
        self.difference = difference
        self.low, self.high = parameterization.bounds()
        self.slopes, self._known_slopes = slopes, slopes is not None
        self._fresh_at: Array | None = None
        self._taken_at: Array | None = None
        self._rows_there = np.zeros(0)
        free = np.arange(parameterization.bounds()[0].size) < parameterization.free
        self._effects = np.flatnonzero(free)
        self._moving = np.flatnonzero(free | parameterization.about_one_trial)
        self._rows: int | None = None
        self._known: dict[bytes, tuple[Array, ...]] = {}

    def learn_from(self, x: Array, near: NearStart) -> None:
        """Take for known what another fit says near a vector, (n,)."""
        slopes = near.slopes
        rows, size = slopes.shape[0], x.size
        self.slopes, self._fresh_at = np.zeros((rows + size, size)), x
        self.slopes[:rows, size - slopes.shape[1] :] = slopes
        self.slopes[rows:] = np.diag(self.parameterization.weights)
        if slopes.shape[1] == size:
            self._taken_at = x  # they hold for the first step
        if near.by_trial is not None:
            self._known[x.tobytes()] = near.by_trial

    def by_trial(self, x: Array) -> tuple[Array, ...]:
        """Residuals / sigma at one vector, (n,), one array per trial, for the iterations of a fit.

        Raises:
          SimulationFailed: the rig cannot be simulated.
        """
        key = x.tobytes()
        if key not in self._known:
            trials = self.problem.residuals([self.parameterization.rig(x)], callback_alone=True)
            self._known = dict(list(self._known.items())[1 - _KEPT :])
            self._known[key] = tuple(trial[0] for trial in trials)
        return self._known[key]

    def at_the_end(self, x: Array) -> tuple[Array, ...]:
        """Residuals / sigma at the end of a fit, one array per trial: MuJoCo's, unless the problem
        says otherwise.

        Raises:
          SimulationFailed: the rig cannot be simulated.
        """
        if self.problem.callback_alone:
            return self.by_trial(x)
        return tuple(trial[0] for trial in self.problem.residuals([self.parameterization.rig(x)]))

    def __call__(self, x: Array) -> Array:
        """Residuals with the prior, (N,) or (N, 1), at a vector, (n,) or (n, 1).

        NaN if the rig cannot be simulated there, so that the optimiser takes the step back.

        Raises:
          SimulationFailed: the rig cannot be simulated at the first vector.
          StoppedEarly: there is no time left for the fit.
        """
        raise_if_stopped()
        flat = np.ascontiguousarray(x.ravel())
        try:
            rows = self._with_prior(self.by_trial(flat), flat)
        except SimulationFailed:
            if self._rows is None:
                raise
            rows = np.full(self._rows, np.nan)
        self._rows = rows.size
        return rows.reshape(-1, *x.shape[1:])

    def _with_prior(self, trials: Sequence[Array], x: Array) -> Array:
        return np.concatenate([*trials, self.parameterization.weights * x])

    def jacobian(self, x: Array, at_x: Array) -> Array:
        """Jacobian by differences, away from the bounds, (N, n); or the known one."""
        flat = x.ravel()
        if self.slopes is not None and (held := self._held(self.slopes, flat, at_x.ravel())) is not None:
            self._taken_at = None  # for one step: slow progress has fresh slopes
            self.slopes = held
            return held
        self._taken_at, self._rows_there = flat, at_x.ravel()
        steps = np.where(flat + self.difference > self.high, -1.0, 1.0) * self.difference
        taken = self._moving
        slopes = np.zeros((at_x.size, flat.size)) if self.slopes is None else np.array(self.slopes)
        if self._fresh_at is None or self._is_far(flat - self._fresh_at):
            taken, self._fresh_at = np.arange(flat.size), flat
        if taken.size:
            slopes[:, taken] = self._changes(flat, at_x, np.diag(steps)[taken]) / steps[taken]
        self.slopes = slopes
        return slopes

    def _held(self, slopes: Array, x: Array, at_x: Array) -> Array | None:
        """The last slopes, if they hold at x, too: known, taken close by, or with what they learn from a
        step that they foretold; None: they do not hold."""
        if self._known_slopes:
            return slopes
        if self._taken_at is None:
            return None
        step = x - self._taken_at
        if np.abs(step).max(initial=0.0) < _NEAR:
            return slopes
        moved = at_x - self._rows_there
        missed = moved - slopes @ step
        if not self.problem.callback_alone:  # intervals need slopes that no step has bent
            return None
        return None if missed @ missed > _MISSED**2 * (moved @ moved) else _learned(slopes, step, missed)

    def _is_far(self, way: Array) -> bool:
        return bool(np.abs(way)[self._effects].max(initial=0.0) > _FAR)

    def _changes(self, x: Array, at_x: Array, steps: Array) -> Array:
        """Changes of residuals with the prior by steps, (k, n), from a vector: (N, k)."""
        if self._of_differences is self.problem:
            return self._side_by_side(x + steps) - at_x.reshape(-1, 1)
        moved = self._side_by_side(np.vstack([x, x + steps]))
        return moved[:, 1:] - moved[:, :1]

    def _side_by_side(self, vectors: Array) -> Array:
        """Residuals with the prior at several vectors, (k, n), for differences: (N, k)."""
        rigs = [self.parameterization.rig(x) for x in vectors]
        trials = self._of_differences.residuals(rigs, callback_alone=True)
        columns = [self._with_prior([t[i] for t in trials], x) for i, x in enumerate(vectors)]
        return np.stack(columns, axis=-1)


def _learned(slopes: Array, step: Array, missed: Array) -> Array:
    """Slopes that foretell a step of which they missed some; what they do not depend on stays so."""
    along = np.where(slopes != 0.0, step, 0.0)
    square = np.sum(along**2, axis=1)
    share = np.divide(missed, square, out=np.zeros_like(missed), where=square > 0)
    return np.asarray(slopes + share[:, np.newaxis] * along)
