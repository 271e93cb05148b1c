"""Candidates in units of the noise that the best of them leaves, checked on held-out trials."""

from collections.abc import Sequence
from dataclasses import replace

from diagnosis.fitting.noise_reestimation import reestimated_noise, rescaled
from diagnosis.fitting.problem import FitProblem
from diagnosis.prepare.sensor_noise import Noise
from diagnosis.selection.candidate import Candidate, candidate


def renoised(problem: FitProblem, candidates: Sequence[Candidate]) -> tuple[Noise, list[Candidate]]:
    """Re-estimated noise, and all candidates in its units, cross-validated, best first.

    Args:
      candidates: best first.
    """
    noise = reestimated_noise(problem, candidates[0].fit)
    again = replace(problem, noise=noise)
    units = [candidate(rescaled(c.fit, problem, noise)) for c in candidates]
    return noise, sorted((c.cross_validated(again) for c in units), key=lambda c: c.score)


def any_explains(problem: FitProblem, candidates: Sequence[Candidate]) -> bool:
    """Whether one of the candidates is at the noise floor, as the best of them leaves it."""
    _, checked = renoised(problem, sorted(candidates, key=lambda c: c.score))
    return any(c.explains for c in checked)
