"""A log beside the predictions of its nominal rig: the end of `needle replay`, the start of a diagnosis.

RigLog -> PreparedLog -> FitProblem, with the noise from the residual of the nominal rig
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from diagnosis.effects import library_of
from diagnosis.fitting.fit import Fit, fit_effects, nominal_fit
from diagnosis.fitting.nuisance import late_starts_of, nuisance_of
from diagnosis.fitting.problem import FitProblem
from diagnosis.log.checks.noise_claims import far_claims
from diagnosis.log.rig_log import RigLog
from diagnosis.log.trial import SENSORS
from diagnosis.lost_counts import with_counts_restored
from diagnosis.prepare.low_band import in_low_band
from diagnosis.prepare.motion.averaging import averaged
from diagnosis.prepare.noise.sensor_noise import Noise, estimate_noise
from diagnosis.prepare.prepare import prepare
from diagnosis.prepare.prepared_log import PreparedLog
from diagnosis.prepare.rig_scale import scale_of
from diagnosis.prepare.start.late_start_detection import (
    begun_as,
    with_late_starts,
    without_unused,
)
from diagnosis.replay.accuracy.uncertain_times import (
    errors_by_times,
    warnings_of_times,
    weighted_by_errors,
)
from diagnosis.replay.accuracy.unsampled_motion import weighted_by_unsampled_motion
from diagnosis.replay.prediction import Prediction
from diagnosis.replay.replay import replay, residuals
from diagnosis.replay.rig_parameters import RigParameters

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class NominalReplay:
    """A log beside the predictions of its nominal rig.

    Attributes:
      log: the log that is diagnosed: averaged, if it has more samples than are of use, and without
        the first readings of trials that began late, and those after uncertain gaps.
      problem: the log, its noise and the nuisance parameters.
      fit: fit of the pasts of trials that began late, and of nothing else.
      predictions: predictions of the nominal rig, by trial of the problem.
    """

    log: RigLog
    problem: FitProblem
    fit: Fit
    predictions: list[Prediction]

    @property
    def rig(self) -> RigParameters:
        """The nominal rig, with the pasts of trials that began late."""
        return self.fit.parameterization.rig(self.fit.x)

    def begun_as(self, problem: FitProblem, fit: Fit) -> "NominalReplay":
        """The same where a search has found that more trials began late, or that laws are others.

        Args:
          problem, fit: of the search: the log with pasts, and their fit to the nominal rig.

        Raises:
          SimulationFailed: the nominal rig cannot be simulated.
        """
        same = self.problem.library is problem.library and self.problem.base == problem.base
        log = replace(self.problem.log, presliding_deg=problem.log.presliding_deg)
        laws = replace(self.problem, library=problem.library, log=log)
        if len(late_starts_of(problem.log)) == len(late_starts_of(self.problem.log)):
            return self if same else replace(self, problem=laws)
        own = replace(laws, log=problem.log, nuisance=problem.nuisance)
        predictions = replay(problem.log, fit.parameterization.rig(fit.x))
        known = without_unused(self.log, problem.log)
        return NominalReplay(log=known, problem=own, fit=fit, predictions=predictions)


def replay_nominal(log: RigLog) -> NominalReplay:
    """Replay a log with its nominal rig; the noise is estimated from the residual.

    Raises:
      SimulationFailed: the nominal rig cannot be simulated.
    """
    read = averaged(with_counts_restored(log, _left_by_the_nominal_rig))
    log = in_low_band(read)
    prepared, base_sigma_deg = prepare(log)
    predictions = replay(prepared)
    noise = _noise(log, prepared, predictions, base_sigma_deg)
    by_times = errors_by_times(prepared, predictions)
    if by_times:  # what scatters by its time is no noise
        quieter = weighted_by_errors(prepared, by_times.fast, noise)
        noise = _noise(log, quieter, predictions, base_sigma_deg)
        noise = replace(noise, warnings=(*noise.warnings, *warnings_of_times(by_times, noise)))
        prepared = weighted_by_errors(prepared, by_times.whole, noise)
    prepared, unsampled = weighted_by_unsampled_motion(prepared, predictions, noise)
    noise = replace(noise, warnings=(*noise.warnings, *unsampled))
    begun = (
        _begun(prepared, predictions, noise)
        if not log.noise_left
        else _begun_as_read(prepared, read, noise)
    )
    known, library = without_unused(log, begun), library_of(scale_of(begun))
    problem = FitProblem(log=begun, noise=noise, nuisance=nuisance_of(begun), library=library)
    if not late_starts_of(begun):
        fit = nominal_fit(nominal_residuals(problem, predictions))
        return NominalReplay(log=known, problem=problem, fit=fit, predictions=predictions)
    fit = fitted_pasts(problem)
    predictions = replay(begun, fit.parameterization.rig(fit.x))
    return NominalReplay(log=known, problem=problem, fit=fit, predictions=predictions)


def fitted_pasts(problem: FitProblem) -> Fit:
    """The fit of the pasts of trials that began late to the nominal rig, and of nothing else.

    Raises:
      SimulationFailed: the nominal rig cannot be simulated.
    """
    return fit_effects(replace(problem, nuisance=late_starts_of(problem.log)), ())


def _begun(log: PreparedLog, predictions: Sequence[Prediction], noise: Noise) -> PreparedLog:
    """The log with late trials marked."""
    left = _residuals(log, predictions)
    return with_late_starts(log, {s: [own for _, own in each] for s, each in left.items()}, noise)


def _begun_as_read(slow: PreparedLog, log: RigLog, noise: Noise) -> PreparedLog:
    """A log in its low band, whose rows are too rare for starts, with late trials marked as it was read.

    Args:
      log: as it was read; of smoothed readings the noise is the claimed one.
    """
    claims = log.rig.sensors.by_column()
    as_read = Noise(sigma=dict(noise.sigma) | {s: claims[s] for s in slow.noise_left if claims[s]})
    prepared, _ = prepare(replace(log, smoothed_above_hz={}))
    return begun_as(slow, _begun(prepared, replay(prepared), as_read))


def _left_by_the_nominal_rig(log: RigLog) -> Array:
    """What the nominal rig leaves of all sensors, in units of the claimed noise, (N,)."""
    claims = log.rig.sensors.by_column()
    prepared, _ = prepare(in_low_band(averaged(log)))
    left = _residuals(prepared, replay(prepared))
    each = [values / (claims[s] or 1.0) for s, parts in left.items() for _, values in parts]
    return np.concatenate(each) if each else np.zeros(0)


def _noise(
    log: RigLog, prepared: PreparedLog, predictions: Sequence[Prediction], base_sigma_deg: float
) -> Noise:
    """Noise of the sensors, from what the nominal rig leaves."""
    left = _residuals(prepared, predictions)
    told = far_claims(log.trials, log.rig.sensors.by_column())
    smoothed = log.smoothed_above_hz
    return estimate_noise(
        log.rig, left, base_sigma_deg, told, prepared.rounded, prepared.means_of, smoothed
    )


def _residuals(
    log: PreparedLog, predictions: Sequence[Prediction]
) -> dict[str, list[tuple[Array, Array]]]:
    """Times, and weighted measured minus nominal in units of the sensor, by sensor and trial."""
    each = list(zip(log.trials, predictions, strict=True))
    return {
        s: [(t.time_s, t.weights.get(s, 1.0) * (t.readings[s] - p[s])) for t, p in each if t.has(s)]
        for s in SENSORS
    }


def at_samples(problem: FitProblem, predictions: Sequence[Prediction]) -> list[Prediction]:
    """Predictions at the samples of the log itself."""
    each = zip(problem.log.trials, predictions, strict=True)
    return [prediction.rows(trial.logged) for trial, prediction in each]


def nominal_residuals(problem: FitProblem, nominal: Sequence[Prediction]) -> tuple[Array, ...]:
    """Residuals / sigma of the nominal rig, one array per trial."""
    each = zip(problem.log.trials, nominal, strict=True)
    return tuple(residuals(trial, prediction, problem.noise) for trial, prediction in each)
