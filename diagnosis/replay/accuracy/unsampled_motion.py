"""What the base did between two of its samples, as noise of what is predicted.

A replay interpolates the base. Near a corner of its motion it errs by up to a quarter of (change of
rate) (time between samples), and the torque by that times the needle's dynamic stiffness: of a good
torque sensor many sigma, for a few samples. How much shows where samples of the motion are left out.
With e2 and e4 the largest changes of a prediction by leaving one in two, and three in four,

    error with all samples = e2 (e2 / e4),    e2 / e4 from 1 / 16 (smooth) to 1 / 2 (a corner),

since each halving takes off the same share. Where half of e2 matters to no sample, e4 is not asked for.
A sample near a corner has the noise sqrt(sigma^2 + error^2), and counts less.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import Akima1DInterpolator
from scipy.ndimage import maximum_filter1d

from diagnosis.criteria.faults import UNSAMPLED_SIGMA
from diagnosis.in_sigma import in_sigma
from diagnosis.log.trial import SENSORS
from diagnosis.prepare.motion.between_samples import between_samples
from diagnosis.prepare.noise.sensor_noise import Noise
from diagnosis.prepare.prepared_log import PreparedLog, PreparedTrial
from diagnosis.replay.prediction import Prediction
from diagnosis.replay.replay import replay

Array = NDArray[np.float64]

_SMOOTH, _CORNER = 1 / 16, 1 / 2  # share of an error that is left with twice the samples
_BESIDE = 4  # samples on either side for which an error counts as well
_LEAST_SAMPLES = 24
_NO_CHANGE = 1e-9  # in sigma


def weighted_by_unsampled_motion(
    log: PreparedLog, predictions: Sequence[Prediction], noise: Noise
) -> tuple[PreparedLog, tuple[str, ...]]:
    """The log, whose samples count for less where the base may have moved otherwise, and warnings.

    Args:
      predictions: of the nominal rig, by trial.

    Raises:
      SimulationFailed: the nominal rig cannot be simulated with fewer samples.
    """
    changes = _changes_sigma(log, predictions, noise, every=2)
    if all(_CORNER * change.max() <= UNSAMPLED_SIGMA for own in changes for change in own.values()):
        return log, ()
    rarer = _changes_sigma(log, predictions, noise, every=4)
    errors = [_errors_sigma(*own) for own in zip(changes, rarer, strict=True)]
    largest = {s: max((float(e[s].max()) for e in errors if s in e), default=0.0) for s in SENSORS}
    rare = {s: size for s, size in largest.items() if size > UNSAMPLED_SIGMA}
    if not rare:
        return log, ()
    trials = (
        trial.counting_less({s: own[s] for s in rare if s in own})
        for trial, own in zip(log.trials, errors, strict=True)
    )
    return replace(log, trials=tuple(trials)), tuple(_warning(s, size) for s, size in rare.items())


def _rarer(log: PreparedLog, every: int, first: int) -> PreparedLog:
    """The log with one in so many samples of its motion, from that one on."""
    return replace(log, trials=tuple(_sampled(trial, every, first) for trial in log.trials))


def _sampled(trial: PreparedTrial, every: int, first: int) -> PreparedTrial:
    samples = trial.time_s.size
    if samples < _LEAST_SAMPLES:
        return trial
    kept = np.unique([0, *range(first, samples, every), samples - 1])
    finer = between_samples(trial.time_s[kept], trial.base_motion_deg[kept])
    return replace(trial, base_motion_deg=np.asarray(Akima1DInterpolator(*finer)(trial.time_s)))


def _changes_sigma(
    log: PreparedLog, predictions: Sequence[Prediction], noise: Noise, *, every: int
) -> list[dict[str, Array]]:
    """Largest change near a sample by leaving one in so many, / sigma, by trial and sensor, (N,)."""
    runs = [replay(_rarer(log, every, first)) for first in range(every)]
    return [
        {
            sensor: _largest_near(np.array([one[sensor] - own[sensor] for one in of_trial]))
            / noise[sensor]
            for sensor in SENSORS
            if trial.has(sensor)
        }
        for trial, own, *of_trial in zip(log.trials, predictions, *runs, strict=True)
    ]


def _largest_near(changes: Array) -> Array:
    return np.asarray(maximum_filter1d(np.abs(changes).max(axis=0), 2 * _BESIDE + 1))


def _errors_sigma(with_half: dict[str, Array], with_quarter: dict[str, Array]) -> dict[str, Array]:
    """Error of a prediction with all samples, / sigma, by sensor, (N,)."""
    errors = {}
    for sensor, change in with_half.items():
        left = change / np.maximum(with_quarter[sensor], _NO_CHANGE)
        errors[sensor] = change * np.clip(left, _SMOOTH, _CORNER)
    return errors


def _warning(sensor: str, error_sigma: float) -> str:
    return (
        f"{sensor}: base_angle_deg is sampled too rarely to tell how the base turned at corners of its "
        f"motion, which matters by up to {in_sigma(error_sigma)}; readings there count for less: sample "
        "faster, or turn more smoothly"
    )
