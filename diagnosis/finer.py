"""A replay as fine as the log asks.

The usual needle is good to a few hundredths of the noise. It is not where elastic
tissue is met by a needle that moves, element by element, or where noise is very small.
So the best explanation is replayed with twice the elements, and with half the step: where
that changes a trial by more than a tenth of the noise, and by no small part of what is
left there beyond noise, the leading explanations are fitted again so finely.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from diagnosis.candidate import Candidate, candidate
from diagnosis.evidence import Evidence, Resolution
from diagnosis.fit import Fit, fit_effects
from diagnosis.predict import predicted_residuals
from diagnosis.team import Team

Array = NDArray[np.float64]

_ENOUGH = 0.1  # of noise: it makes 1.12 of the slow part, which may be 1.25
_PART = 0.25  # of the sum of squares beyond noise: a smaller one is not why a log is not explained
_ELEMENTS, _STEP_S = 48, 0.0025  # finest
_CONTENDING = 60.0  # of score: what lies further behind is out of the question


def finely_fitted(
    evidence: Evidence, candidates: Sequence[Candidate], team: Team
) -> tuple[Evidence, list[Candidate]]:
    """Evidence with a replay that is fine enough, and candidates fitted on it, best first.

    Args:
      candidates: fitted on the evidence; they come back as they are if it is fine enough.
    """
    found = sorted(candidates, key=lambda c: c.score)
    while (finer := _finer(evidence, found[0].fit)) != evidence.resolution:
        evidence = replace(evidence, resolution=finer)
        found = sorted(_again(evidence, found, team), key=lambda c: c.score)
    return evidence, found


def _finer(evidence: Evidence, best: Fit) -> Resolution:
    """The resolution with more elements and shorter steps, as far as they would change a trial."""
    there = evidence.resolution
    more = replace(there, elements=min(2 * there.elements, _ELEMENTS))
    shorter = replace(there, step_s=max(there.step_s / 2, _STEP_S))
    return Resolution(
        elements=more.elements if _matters(evidence, best, more) else there.elements,
        step_s=shorter.step_s if _matters(evidence, best, shorter) else there.step_s,
    )


def _matters(evidence: Evidence, best: Fit, resolution: Resolution) -> bool:
    if resolution == evidence.resolution:
        return False
    finer = replace(evidence, resolution=resolution)
    runs = predicted_residuals(finer, [best.coordinates.rig(best.x)])
    return any(_is_much(r[0] - left, left) for r, left in zip(runs, best.by_trial, strict=True))


def _is_much(change: Array, left: Array) -> bool:
    """Whether a change of a trial's residual matters to what is left of it."""
    return float(change @ change) > max(_ENOUGH**2 * left.size, _PART * (float(left @ left) - left.size))


def _again(evidence: Evidence, candidates: Sequence[Candidate], team: Team) -> list[Candidate]:
    """The leading candidates, fitted from where they are."""
    near = [c.fit for c in candidates if c.score - candidates[0].score <= _CONTENDING]
    calls = [(replace(evidence, nuisance=f.coordinates.nuisance), f.names, f.x) for f in near]
    return [candidate(fit) for fit in team.each("fitting more finely", fit_effects, calls)]
