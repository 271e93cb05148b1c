"""Times of samples that are not exact, as noise of what is predicted.

Where samples were taken unevenly under even stamps, the base tells when, but for the noise of its
reading and the error of the curve beside which it is read. A sample at t that was taken at t + e has the
base's angle, and the readings, of then. How much that matters shows where a trial is replayed at other
times, which differ by examples of these errors. They are alike for some samples. So the error counts
with the largest of the root mean squares of its means over n samples, times sqrt(n): white noise of that
size is no smaller in any mean. A reading there has the noise sqrt(sigma^2 + error^2), and counts less.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import correlate1d, uniform_filter1d

from diagnosis.criteria.faults import UNSAMPLED_SIGMA
from diagnosis.in_sigma import in_sigma
from diagnosis.log.trial import SENSORS
from diagnosis.prepare.noise.sensor_noise import Noise
from diagnosis.prepare.prepared_log import PreparedLog
from diagnosis.replay.prediction import Prediction
from diagnosis.replay.replay import replay

Array = NDArray[np.float64]

_FOURTH = np.array([1.0, -4.0, 6.0, -4.0, 1.0])
_MEANS_OF = (1, 5, 25)
_ABOUT = 5  # samples over which the squares of changes are averaged
_NEAREST = 0.1  # of the time to the next sample, by which two of them stay apart


@dataclass(frozen=True, kw_only=True)
class TimeErrors:
    """Standard deviations of predictions, in units of the sensor, by trial and sensor, (N,).

    Attributes:
      whole: of all of an error.
      fast: of its part that changes from sample to sample, as noise does.
    """

    whole: tuple[dict[str, Array], ...]
    fast: tuple[dict[str, Array], ...]


def errors_by_times(log: PreparedLog, predictions: Sequence[Prediction]) -> TimeErrors | None:
    """Errors of predictions by times that are not exact; None: they are.

    Args:
      predictions: of the nominal rig, by trial.

    Raises:
      SimulationFailed: the nominal rig cannot be simulated at other times.
    """
    examples = max((len(t.time_errors_s) for t in log.trials if t.time_errors_s is not None), default=0)
    if not examples:
        return None
    runs = [replay(_at_other_times(log, k)) for k in range(examples)]
    changes = [
        {s: np.stack([run[i][s] - own[s] for run in runs]) for s in SENSORS if trial.has(s)}
        for i, (trial, own) in enumerate(zip(log.trials, predictions, strict=True))
    ]
    whole, fast = (
        tuple({s: size(own) for s, own in each.items()} for each in changes)
        for size in (_as_white, _fast)
    )
    return TimeErrors(whole=whole, fast=fast)


def weighted_by_errors(
    log: PreparedLog, errors: Sequence[Mapping[str, Array]], noise: Noise
) -> PreparedLog:
    """The log, whose readings count for less where their prediction errs, by trial and sensor, (N,)."""
    each = zip(log.trials, errors, strict=True)
    trials = (t.counting_less({s: e / noise[s] for s, e in own.items()}) for t, own in each)
    return replace(log, trials=tuple(trials))


def warnings_of_times(errors: TimeErrors, noise: Noise) -> tuple[str, ...]:
    """Warnings of sensors for which the times matter."""
    read = {s: [float(own[s].max()) / noise[s] for own in errors.whole if s in own] for s in SENSORS}
    largest = {s: max(own) for s, own in read.items() if own}
    return tuple(_warning(s, size) for s, size in largest.items() if size > UNSAMPLED_SIGMA)


def _at_other_times(log: PreparedLog, k: int) -> PreparedLog:
    """The log with its samples at the times of an example."""
    trials = (
        trial
        if (errors_s := trial.time_errors_s) is None
        else replace(trial, time_s=_in_order(trial.time_s, -errors_s[k]))
        for trial in log.trials
    )
    return replace(log, trials=tuple(trials))


def _in_order(time_s: Array, late_s: Array) -> Array:
    """Times that are late by that, (N,), as far as they stay in order between the same ends."""
    steps = np.diff(time_s)
    room = (1 - _NEAREST) / 2 * np.minimum(np.append(steps, steps[-1]), np.append(steps[0], steps))
    moved = np.clip(late_s, -room, room)
    moved[[0, -1]] = 0.0
    return np.asarray(time_s + moved)


def _fast(changes: Array) -> Array:
    """Deviation of fourth differences, as multiples that leave white noise its size, (N,)."""
    return _deviation(correlate1d(changes, _FOURTH / np.linalg.norm(_FOURTH), axis=1))


def _deviation(changes: Array) -> Array:
    """Root mean square over examples, (K, N), and a few samples on either side, (N,)."""
    return np.asarray(np.sqrt(np.maximum(uniform_filter1d(np.mean(changes**2, axis=0), _ABOUT), 0.0)))


def _as_white(changes: Array) -> Array:
    """Standard deviation of white noise that is no smaller in means over any number of samples, (N,)."""
    sums = [np.sqrt(n) * uniform_filter1d(changes, n, axis=1) for n in _MEANS_OF]
    return np.asarray(np.max([_deviation(each) for each in sums], axis=0))


def _warning(sensor: str, error_sigma: float) -> str:
    return (
        f"{sensor}: it is not known exactly when rows were read, which matters by up to "
        f"{in_sigma(error_sigma)}; readings there count for less: stamp rows when they are read"
    )
