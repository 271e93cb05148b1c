"""Which effect, or which pair of them, explains a log.

1. Every effect of the vocabulary is fitted a little; the most promising ones wholly.
2. If none of them brings the residual to the noise floor, pairs of the promising
   ones with every other effect are fitted, the more promising first.
3. Fits are ranked by cost plus log(samples) a parameter (BIC): richer effects pay
   for their freedom. What the nuisance of the rig's own scatter explains is `none`.
"""

from collections.abc import Callable, Iterable, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from itertools import combinations

import numpy as np

from diagnosis.effects import LIBRARY
from diagnosis.fit import NUISANCE_SPREAD, Fit, fit_effects
from diagnosis.noise import Noise
from diagnosis.rig_log import RigLog
from diagnosis.whiteness import Floor, floor_of
from models.errors import NeedleError
from sim.kernel.callback import install

SCATTER = 2 * NUISANCE_SPREAD
_GLANCE = 3  # iterations of a first fit
_PROMISING = 6
_LEADING = 3  # effects whose pairs are tried
_PAIRS = 24
_NEEDS = {
    "load_dependent_friction": "tip_torque_n_mm",
    "tip_angle_bias": "tip_angle_deg",
    "tip_angle_scale": "tip_angle_deg",
    "tip_sensor_delay": "tip_angle_deg",
    "torque_bias": "base_torque_n_mm",
}


@dataclass(frozen=True, kw_only=True)
class Candidate:
    """A fitted explanation.

    Attributes:
      score: cost plus log(samples) a parameter; less is better.
      floor: how far its residual is above the noise.
    """

    fit: Fit
    score: float
    floor: Floor

    @property
    def names(self) -> tuple[str, ...]:
        """Of its effects; none for the nominal rig."""
        return self.fit.names


def named(candidate: Candidate) -> tuple[str, ...]:
    """Effects of a candidate, with a scatter of the rig that is too large to be scatter."""
    count = len(candidate.fit.coordinates.nuisance)
    values = candidate.fit.x[candidate.fit.x.size - count :]
    beyond = [
        effect.name
        for effect, value in zip(candidate.fit.coordinates.nuisance, values, strict=True)
        if abs(value) > SCATTER
    ]
    return (*candidate.names, *beyond)


def candidate(fit: Fit) -> Candidate:
    """A fit with its score."""
    score = fit.cost + fit.size * float(np.log(max(fit.samples, 2)))
    return Candidate(fit=fit, score=score, floor=floor_of(fit.by_trial))


def possible_effects(log: RigLog) -> tuple[str, ...]:
    """Effects that the signals of a log can show at all."""
    return tuple(
        name
        for name in LIBRARY
        if name not in _NEEDS or any(trial.has(_NEEDS[name]) for trial in log.trials)
    )


def search(
    log: RigLog,
    noise: Noise,
    *,
    workers: int = 2,
    progress: Callable[[str, float], None] = lambda what, share: None,
) -> list[Candidate]:
    """Candidates that were fitted wholly, best first; `none` is among them."""
    install()
    found = [
        candidate(fit_effects(log, noise, (), nuisance=False)),
        candidate(fit_effects(log, noise, ())),
    ]
    if found[0].floor.reached and found[0].score <= found[1].score + 10:
        found = found[:1]
    with ProcessPoolExecutor(workers) as pool:
        singles = [(name,) for name in possible_effects(log)]
        glances = _fit_all(pool, log, noise, singles, _GLANCE, progress, "glancing at effects")
        leading = [c.names for c in sorted(glances, key=lambda c: c.score)[:_PROMISING]]
        found += _fit_all(pool, log, noise, leading, 0, progress, "fitting effects")
        if not any(c.floor.reached for c in found):
            pairs = _pairs([c.names[0] for c in sorted(glances, key=lambda c: c.score)])
            found += _fit_all(pool, log, noise, pairs, 0, progress, "fitting pairs")
    best = min(found, key=lambda c: c.score)
    if named(best) != best.names:
        # What is no scatter is fitted without the prior of scatter, which would pull it.
        found.append(candidate(fit_effects(log, noise, named(best))))
    return sorted(found, key=lambda c: c.score)


def _pairs(ranked: Sequence[str]) -> list[tuple[str, ...]]:
    """Pairs with one of the leading effects, and of the others by rank."""
    pairs: list[tuple[str, ...]] = [p for p in combinations(ranked, 2) if p[0] in ranked[:_LEADING]]
    ordered = sorted(pairs, key=lambda p: ranked.index(p[0]) + ranked.index(p[1]))
    return ordered[:_PAIRS]


def _fit_all(
    pool: ProcessPoolExecutor,
    log: RigLog,
    noise: Noise,
    sets: Iterable[tuple[str, ...]],
    iterations: int,
    progress: Callable[[str, float], None],
    what: str,
) -> list[Candidate]:
    tasks = [pool.submit(_fit, log, noise, names, iterations) for names in sets]
    found = []
    for i, task in enumerate(tasks):
        fit = task.result()
        if fit is not None:
            found.append(candidate(fit))
        progress(what, (i + 1) / len(tasks))
    return found


def _fit(log: RigLog, noise: Noise, names: tuple[str, ...], iterations: int) -> Fit | None:
    """A fit, or None where a candidate cannot be simulated."""
    try:
        if iterations:
            return fit_effects(log, noise, names, most_iterations=iterations)
        return fit_effects(log, noise, names)
    except NeedleError:
        return None
