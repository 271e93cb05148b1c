"""Candidates checked: in units of the noise that the best of them leaves, and on held-out trials."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

from diagnosis.fitting.fit import Fit, completed
from diagnosis.fitting.noise_reestimation import reestimated_noise, rescaled
from diagnosis.fitting.problem import FitProblem
from diagnosis.prepare.noise.sensor_noise import Noise
from diagnosis.selection.candidate import Candidate, candidate
from diagnosis.selection.scoring.base_noise import allowing_base_noise, with_base_noise_cost
from sim.needles.run import SimulationFailed


@dataclass(frozen=True, kw_only=True, eq=False)
class Checked:
    """Candidates that were checked, best first.

    Attributes:
      problem: that they were fitted to, in units of the first estimate of the noise.
      leading: fit of least score there.
      noise: re-estimated from what this leaves.
      fits: of the candidates, in units of the first estimate, in their order.
    """

    problem: FitProblem
    leading: Fit
    noise: Noise
    candidates: tuple[Candidate, ...]
    fits: tuple[Fit, ...]

    @property
    def explains(self) -> bool:
        """Whether one of them explains the log."""
        return any(c.explains for c in self.candidates)

    def of(self, fit: Fit, noise: Noise) -> Candidate | None:
        """What was found of a fit under that noise; None: it was not checked."""
        if not noise.same(self.noise):
            return None
        each = zip(self.fits, self.candidates, strict=True)
        return next((known for own, known in each if own is fit), None)


def check(problem: FitProblem, candidates: Sequence[Candidate], known: Checked | None = None) -> Checked:
    """Check candidates.

    Args:
      candidates: fitted to the problem.
      known: checked before; what is the same is not simulated once more.
    """
    leading = min(candidates, key=lambda c: c.score).fit
    if known and known.problem is problem and known.leading is leading:
        noise = known.noise
    else:
        noise = reestimated_noise(problem, leading)
    again = replace(problem, noise=noise)

    def checked(fit: Fit) -> Candidate:
        before = known.of(fit, noise) if known else None
        return before or _checked(candidate(rescaled(fit, problem, noise)), again)

    each = sorted(((checked(c.fit), c.fit) for c in candidates), key=lambda pair: pair[0].score)
    return Checked(
        problem=problem,
        leading=leading,
        noise=noise,
        candidates=tuple(c for c, _ in each),
        fits=tuple(fit for _, fit in each),
    )


def _checked(one: Candidate, problem: FitProblem) -> Candidate:
    try:
        found = _completed(allowing_base_noise(one, problem), problem).cross_validated(problem)
        if not found.floor.reached:
            return found
        return with_base_noise_cost(allowing_base_noise(found, problem), problem)
    except SimulationFailed:
        return one.cross_validated(problem)  # with another motion it cannot be simulated


def _completed(one: Candidate, problem: FitProblem) -> Candidate:
    """The same at its minimum, where a fit that was given up explains the log after all."""
    if not (one.floor.reached and one.fit.status.ended_early):
        return one
    again = allowing_base_noise(candidate(completed(problem, one.fit)), problem)
    return again if again.score < one.score else one
