"""From a log to a diagnosis: replay, noise, search, verdict, gap and where it lives."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from diagnosis.advice import advise
from diagnosis.base_motion import without_base_noise
from diagnosis.bridging import bridged, original
from diagnosis.evidence import FINE, Evidence, Resolution
from diagnosis.further import further, on_thinned
from diagnosis.gap import Gap, gap_of
from diagnosis.held_out import held_out
from diagnosis.hidden import hiding_beside
from diagnosis.limits import possible_effects
from diagnosis.noise import Noise, estimate_noise
from diagnosis.nuisance import nuisance_of
from diagnosis.parameters import Interval, intervals
from diagnosis.predict import Prediction, predict
from diagnosis.refine import refined
from diagnosis.replay_error import replay_change, replay_error, warnings_of
from diagnosis.rig_log import SENSORS, RigLog
from diagnosis.rig_model import RigModel
from diagnosis.search import search
from diagnosis.strength import strongest_first
from diagnosis.team import Progress, silent, team
from diagnosis.thinning import thinned
from diagnosis.verdict import Outcome, Verdict, judge
from diagnosis.where import Where, locate

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class Diagnosis:
    """Everything that a report is made of; predictions are in the order of the trials.

    Attributes:
      where: the gap to the nominal rig lives, and where what is left of it does.
      further: gap that one more effect may bring it down to, by effect.
      hidden: parameters at the largest strength that the log would hide, by effect; empty where
        the log is not explained, or by two effects.
    """

    log: RigLog
    noise: Noise
    replay_error: dict[str, float]
    verdict: Verdict
    gap: Gap
    where: Where
    where_left: Where
    parameters: dict[str, dict[str, Interval]]
    further: dict[str, float]
    hidden: dict[str, dict[str, float]]
    next_experiment: str
    nominal: list[Prediction]
    explained: list[Prediction]

    @property
    def warnings(self) -> tuple[str, ...]:
        """Of the log, of its noise and of the replay."""
        return (*self.log.warnings, *self.noise.warnings, *warnings_of(self.replay_error))


def diagnose(log: RigLog, *, workers: int = 2, progress: Progress = silent) -> Diagnosis:
    """Diagnose a log."""
    driven = without_base_noise(bridged(log))
    replayed = _predicted(driven, RigModel())
    nominal = _at_samples(log, driven, replayed)
    missed = {
        sensor: [
            trial[sensor] - prediction[sensor]
            for trial, prediction in zip(driven.trials, replayed, strict=True)
            if trial.has(sensor)
        ]
        for sensor in SENSORS
    }
    noise = estimate_noise(log, missed)
    evidence = Evidence(log=driven, noise=noise, nuisance=nuisance_of(driven))
    coarse, effects = thinned(evidence, replayed), possible_effects(log)
    with team(workers, progress) as workforce:
        evidence, found = search(evidence, coarse, effects, workforce)
        noise, candidates = refined(evidence, found)
        evidence, verdict = replace(evidence, noise=noise), judge(candidates)
        best = verdict.best.fit
        base = on_thinned(coarse, best)
        left = further(coarse, best, base, effects, workforce)
        hiding = hiding_beside(coarse, best, base, effects, workforce) if verdict.settled else {}
    if verdict.outcome is Outcome.EXPLAINED:
        verdict = replace(verdict, effects=strongest_first(evidence, verdict.best))
    rig = best.coordinates.rig(best.x)
    explained = _at_samples(log, driven, _predicted(driven, rig, evidence.resolution))
    change = replay_change(evidence, rig)
    where_left = locate(log, explained, noise)
    return Diagnosis(
        log=log,
        noise=noise,
        replay_error=replay_error(change),
        verdict=verdict,
        gap=gap_of(tuple(_over_noise(missed, noise, driven)), held_out(evidence, best)),
        where=locate(log, nominal, noise),
        where_left=where_left,
        parameters={e: p for e, p in intervals(evidence, best, change).items() if e in verdict.effects},
        further=left,
        hidden=hiding,
        next_experiment=advise(coarse, verdict, where_left),
        nominal=nominal,
        explained=explained,
    )


def _predicted(log: RigLog, rig: RigModel, resolution: Resolution = FINE) -> list[Prediction]:
    return [predict(log.rig, trial, [rig], resolution)[0] for trial in log.trials]


def _at_samples(log: RigLog, driven: RigLog, predictions: list[Prediction]) -> list[Prediction]:
    """Predictions at the samples of the log itself."""
    each = zip(log.trials, driven.trials, predictions, strict=True)
    return [p.rows(original(trial, bridge)) for trial, bridge, p in each]


def _over_noise(missed: dict[str, list[Array]], noise: Noise, log: RigLog) -> list[Array]:
    """Residuals of the nominal rig over noise, one array a trial."""
    taken = {sensor: iter(values) for sensor, values in missed.items()}
    found = []
    for trial in log.trials:
        parts = [next(taken[s]) / noise[s] for s in SENSORS if trial.has(s)]
        joined = np.concatenate(parts) if parts else np.zeros(0)
        found.append(joined[np.isfinite(joined)])
    return found
