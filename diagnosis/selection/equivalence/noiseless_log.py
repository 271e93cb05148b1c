"""What an explanation predicts, without noise, in place of the readings of a log.

Of this log nothing scatters, so that two sets of effects that fit it are alike whatever the noise.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from diagnosis.criteria.fitting import SCATTER
from diagnosis.effects import LIBRARY
from diagnosis.fitting.nuisance import CONVENTIONS
from diagnosis.fitting.problem import FitProblem
from diagnosis.prepare.prepared_log import PreparedTrial
from diagnosis.replay.replay import predict
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.selection.candidate import Candidate

Array = NDArray[np.float64]
Parts = dict[str, Array]

_DIFFERENCE = 1e-3  # of the nuisance, in the units of a fit


@dataclass(frozen=True, kw_only=True, eq=False)
class NoiselessLog:
    """A log that reads what an explanation predicts.

    Attributes:
      problem: whose readings are those.
      own: parts of the named effects of the explanation.
      kept: of what is open besides.
      changed: what its named effects change of all readings, / sigma, (N,).
      middle: the same of half of each of them.
    """

    problem: FitProblem
    own: Parts
    kept: Parts
    changed: Array
    middle: Array

    @property
    def power(self) -> float:
        """Sum of squares of what the named effects change."""
        return float(self.changed @ self.changed)

    @property
    def prior(self) -> float:
        """Cost of what is open besides."""
        parameterization = self.problem.parameterization(())
        weighted = parameterization.weights * parameterization.joined(self.kept)
        return float(weighted @ weighted)

    @property
    def halved(self) -> Parts:
        """All of it, with half of each named effect."""
        return _halved(self.problem, self.own) | self.kept

    def readings(self, parts: Parts) -> Array:
        """What the explanation reads more than a rig with these parts, / sigma, (N,)."""
        return _readings(self.problem, parts)

    def slopes(self) -> tuple[Array, Array]:
        """Of what is open besides: slopes of the readings, (N, k), and weights of the prior, (k,)."""
        parameterization, half = self.problem.parameterization(()), self.halved
        x = parameterization.joined(half)
        _, high = parameterization.bounds()
        steps = np.where(x + _DIFFERENCE > high, -_DIFFERENCE, _DIFFERENCE)
        slopes = np.zeros((self.middle.size, x.size))
        for i, step in enumerate(np.diag(steps)):
            moved = self.readings(half | parameterization.parts(x + step))
            slopes[:, i] = (self.middle - moved) / steps[i]
        return slopes, parameterization.weights


def noiseless_log(
    coarse: FitProblem, best: Candidate, whole: Sequence[str], *, scatters: bool = True
) -> NoiselessLog:
    """Without pasts, and without scatter where it does not name it: what is alike is alike without them.

    Args:
      coarse: the decimated log.
      best: the explanation.
      whole: effects of it that stay whole and open.
      scatters: whether stiffness and damping that it names may be what scatters about another set.
    """
    sensors = (coarse.library[n] for n in best.names if n not in LIBRARY or n in whole)
    own = {name: best.fit.parts[name] for name in best.named if name not in whole}
    allowed = {*CONVENTIONS, *(SCATTER if scatters and names_scatter(best) else ())}
    open_ = (*sensors, *(e for e in coarse.nuisance if e.name in allowed))
    kept = {e.name: best.fit.parts[e.name] for e in open_ if e.name not in own}
    # Without noise, slopes of runs half as fine would lead nowhere near the end.
    problem = replace(coarse, nuisance=open_, differences_halved=False)
    rig = _rig(problem, own | kept)
    trials = tuple(_reading(problem, trial, rig) for trial in coarse.log.trials)
    problem = replace(problem, log=replace(coarse.log, trials=trials))
    changed = _readings(problem, kept)
    middle = _readings(problem, _halved(problem, own) | kept)
    return NoiselessLog(problem=problem, own=own, kept=kept, changed=changed, middle=middle)


def names_scatter(best: Candidate) -> bool:
    """Whether it names stiffness or damping that every fit leaves open."""
    return bool({*SCATTER} & ({*best.named} - {*best.names}))


def _halved(problem: FitProblem, parts: Parts) -> Parts:
    return {name: problem.library[name].weakened(part, 0.5) for name, part in parts.items()}


def _reading(problem: FitProblem, trial: PreparedTrial, rig: RigParameters) -> PreparedTrial:
    """A trial that reads what a rig predicts, wherever it read anything."""
    found = predict(problem.log.rig, trial, [rig], problem.resolution)[0]
    read = {s: np.where(np.isfinite(own), found[s], np.nan) for s, own in trial.readings.items()}
    return replace(trial, readings=read)


def _rig(problem: FitProblem, parts: Parts) -> RigParameters:
    open_ = {e.name for e in problem.nuisance}
    parameterization = problem.parameterization([name for name in parts if name not in open_])
    return parameterization.rig(parameterization.joined(parts))


def _readings(problem: FitProblem, parts: Parts) -> Array:
    return np.concatenate([trial[0] for trial in problem.residuals([_rig(problem, parts)])])
