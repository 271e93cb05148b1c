"""The noise floor once more, from what the best explanation leaves.

Fourth differences see the noise whatever the nominal model misses, but use the data
badly: to 2 % from some thousands of samples. What is left by a good explanation is
white, and first differences of it tell the noise to 1 %. They are believed as far as
they are within 8 % of the first estimate: beyond, something fast is left in them.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from diagnosis.candidate import Candidate, candidate
from diagnosis.evidence import Evidence
from diagnosis.noise import Noise
from diagnosis.rig_log import SENSORS

Array = NDArray[np.float64]

_TRUST = 0.08


def refined(evidence: Evidence, candidates: Sequence[Candidate]) -> tuple[Noise, list[Candidate]]:
    """Noise as the best candidate leaves it, and all candidates in its units and on unseen trials."""
    parts = _by_sensor(evidence, candidates[0].fit.by_trial)
    change = {s: _white(own) for s, own in parts.items()}
    sigma = evidence.noise.sigma | {s: evidence.noise[s] * f for s, f in change.items()}
    rows = [
        np.concatenate([np.full(size, change[s]) for s, size in sizes.items()])
        for sizes in _sizes(evidence)
    ]
    noise = replace(evidence.noise, sigma=sigma)
    again = replace(evidence, noise=noise)
    rescaled = [_rescaled(c, rows).looked_at(again) for c in candidates]
    return noise, sorted(rescaled, key=lambda c: c.score)


def _white(parts: Sequence[Array]) -> float:
    """Standard deviation of what is white in residuals that are in units of the first estimate."""
    steps = np.concatenate([np.diff(part) for part in parts])
    found = float(np.sqrt(0.5 * np.mean(steps**2))) if steps.size else 1.0
    return float(np.clip(found, 1 - _TRUST, 1 + _TRUST))


def _sizes(evidence: Evidence) -> list[dict[str, int]]:
    """Readings of each trial, by sensor."""
    return [
        {s: int(np.isfinite(trial[s]).sum()) for s in SENSORS if trial.has(s)}
        for trial in evidence.log.trials
    ]


def _by_sensor(evidence: Evidence, by_trial: Sequence[Array]) -> dict[str, list[Array]]:
    found: dict[str, list[Array]] = {}
    for sizes, residual in zip(_sizes(evidence), by_trial, strict=True):
        ends = np.cumsum(list(sizes.values()))
        for sensor, part in zip(sizes, np.split(residual, ends[:-1]), strict=True):
            found.setdefault(sensor, []).append(part)
    return found


def _rescaled(one: Candidate, rows: Sequence[Array]) -> Candidate:
    fit = one.fit
    by_trial = tuple(r / f for r, f in zip(fit.by_trial, rows, strict=True))
    prior = fit.coordinates.weights * fit.x
    cost = sum(float(r @ r) for r in by_trial) + float(prior @ prior)
    jacobian = tuple(j / f[:, None] for j, f in zip(fit.jacobian, rows, strict=True))
    return candidate(replace(fit, by_trial=by_trial, jacobian=jacobian, cost=cost))
