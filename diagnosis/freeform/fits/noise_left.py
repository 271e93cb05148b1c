"""The noise that a free-form law leaves, and fits in units of it.

The noise of an unknown log is that beside what comes nearest: what nothing explains so far, and is
fast, passes for coloured noise there, which is larger than the noise is. A law that closes the gap in
this noise tells what the noise is without it.
"""

from collections.abc import Sequence
from dataclasses import replace

from diagnosis.criteria.freeform import CLOSED_GAP, NOISE_LEFT
from diagnosis.fitting.decimation import decimated_noise
from diagnosis.fitting.noise_reestimation import reestimated_noise, rescaled
from diagnosis.fitting.problem import FitProblem
from diagnosis.freeform.fits.free_fit import FreeFit, with_family
from diagnosis.prepare.noise.sensor_noise import Noise


def noise_left(problem: FitProblem, fits: Sequence[FreeFit]) -> Noise | None:
    """The noise that the best fit of the log itself leaves; None, unless coloured noise is less then."""
    finals = [f for f in fits if f.final and f.fit.gap <= CLOSED_GAP]
    if not finals or not problem.noise.colour:
        return None
    best = min(finals, key=lambda f: f.score)
    noise = reestimated_noise(with_family(problem, *best.families), best.fit)
    less = any(noise[s] < NOISE_LEFT * problem.noise[s] for s in problem.noise.colour)
    return noise if less else None


def in_noise(problem: FitProblem, coarse: FitProblem, noise: Noise) -> tuple[FitProblem, FitProblem]:
    """The log itself, and decimated, in another noise."""
    rare = decimated_noise(noise, problem.log, coarse.log)
    return replace(problem, noise=noise), replace(coarse, noise=rare)


def rescaled_fits(fits: Sequence[FreeFit], coarse: FitProblem, noise: Noise) -> list[FreeFit]:
    """Fits of the decimated log with residuals in units of another noise of it."""
    each = ((one, rescaled(one.fit, coarse, noise)) for one in fits)
    return [replace(one, fit=fit, gap_after=fit.gap) for one, fit in each]
