"""From a log to a diagnosis: replay, noise, search, verdict, gap and where it lives."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from diagnosis.fit import Fit
from diagnosis.held_out import held_out
from diagnosis.noise import Noise, estimate_noise
from diagnosis.predict import Prediction, predict
from diagnosis.rig_log import SENSORS, RigLog
from diagnosis.rig_model import RigModel
from diagnosis.search import search
from diagnosis.verdict import Verdict, judge
from diagnosis.where import Where, locate

Array = NDArray[np.float64]

_BOOTSTRAPS = 400


@dataclass(frozen=True, kw_only=True)
class Gap:
    """Root mean square residual over noise, held out, before and after; 1 is the floor."""

    before: float
    after: float
    shrink: float
    shrink_low: float
    shrink_high: float


@dataclass(frozen=True, kw_only=True)
class Diagnosis:
    """Everything that a report is made of; predictions are in the order of the trials."""

    log: RigLog
    noise: Noise
    verdict: Verdict
    gap: Gap
    where: Where
    nominal: list[Prediction]
    explained: list[Prediction]


def diagnose(
    log: RigLog,
    *,
    workers: int = 2,
    progress: Callable[[str, float], None] = lambda what, share: None,
) -> Diagnosis:
    """Diagnose a log."""
    nominal = [predict(log, trial, [RigModel()])[0] for trial in log.trials]
    missed = {
        sensor: [
            trial[sensor] - prediction[sensor]
            for trial, prediction in zip(log.trials, nominal, strict=True)
            if trial.has(sensor)
        ]
        for sensor in SENSORS
    }
    noise = estimate_noise(log, missed)
    candidates = search(log, noise, workers=workers, progress=progress)
    verdict = judge(candidates)
    best = verdict.best.fit
    rig = best.coordinates.rig(best.x)
    before = tuple(_over_noise(missed, noise, log))
    return Diagnosis(
        log=log,
        noise=noise,
        verdict=verdict,
        gap=gap_of(before, best),
        where=locate(log, nominal, noise),
        nominal=nominal,
        explained=[predict(log, trial, [rig])[0] for trial in log.trials],
    )


def _over_noise(missed: dict[str, list[Array]], noise: Noise, log: RigLog) -> list[Array]:
    """Residuals of the nominal rig over noise, one array a trial."""
    taken = {sensor: iter(values) for sensor, values in missed.items()}
    found = []
    for trial in log.trials:
        parts = [next(taken[s]) / noise[s] for s in SENSORS if trial.has(s)]
        joined = np.concatenate(parts) if parts else np.zeros(0)
        found.append(joined[np.isfinite(joined)])
    return found


def gap_of(before: tuple[Array, ...], best: Fit) -> Gap:
    """Gap before and after on held-out trials, its shrinkage from resampled blocks."""
    after = held_out(best)
    squares = [
        np.stack([_blocks(b**2), _blocks(a**2)])
        for b, a in zip(before, after, strict=True)
        if b.size >= _BLOCK
    ]
    pooled = np.concatenate(squares, axis=1) if squares else np.ones((2, 1))
    ratio = _shrink(pooled)
    rng = np.random.default_rng(0)
    picks = rng.integers(0, pooled.shape[1], size=(_BOOTSTRAPS, pooled.shape[1]))
    low, high = np.quantile([_shrink(pooled[:, pick]) for pick in picks], [0.025, 0.975])
    return Gap(
        before=_rms(before),
        after=_rms(after),
        shrink=ratio,
        shrink_low=float(low),
        shrink_high=float(high),
    )


_BLOCK = 100  # samples that are resampled together: residuals of a gap are not independent


def _blocks(values: Array) -> Array:
    return np.asarray(values[: values.size // _BLOCK * _BLOCK].reshape(-1, _BLOCK).mean(axis=1))


def _shrink(squares: Array) -> float:
    before, after = squares.mean(axis=1)
    return float(1 - np.sqrt(after / before)) if before > 0 else 0.0


def _rms(by_trial: tuple[Array, ...]) -> float:
    values = np.concatenate(by_trial)
    return float(np.sqrt(np.mean(values**2))) if values.size else float("nan")
