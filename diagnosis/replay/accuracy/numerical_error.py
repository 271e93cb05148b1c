"""Numerical error of a replay: the change by half the step and twice the elements, in sigma."""

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from diagnosis.cores import side_by_side
from diagnosis.criteria.replay import NUMERICAL_ERROR_WARNED
from diagnosis.in_sigma import in_sigma
from diagnosis.log.trial import SENSORS
from diagnosis.prepare.noise.sensor_noise import Noise
from diagnosis.prepare.prepared_log import PreparedLog, PreparedTrial
from diagnosis.replay.prediction import Prediction
from diagnosis.replay.replay import predict
from diagnosis.replay.resolution import Resolution
from diagnosis.replay.rig_parameters import RigParameters

Array = NDArray[np.float64]


def refinement_change(
    log: PreparedLog,
    noise: Noise,
    rig: RigParameters,
    predictions: Sequence[Prediction],
    resolution: Resolution,
) -> list[dict[str, Array]]:
    """Change by half the step and twice the elements, / sigma and whitened, by trial and sensor.

    The method is of second order in the step and of higher order in the elements: the
    remaining error is about a third of the change.

    Args:
      predictions: predictions of the rig at this resolution, by trial.

    Raises:
      SimulationFailed: the rig cannot be simulated with the finer resolution.
    """

    def change(trial: PreparedTrial, here: Prediction) -> dict[str, Array]:
        finer = Resolution(elements=2 * resolution.elements, step_s=0.5 * resolution.step_of(trial))
        there = predict(log.rig, trial, [rig], finer, callback_alone=True)[0]
        moved = {s: (there[s] - here[s]) / noise[s] for s in SENSORS if trial.has(s)}
        read = {s: np.isfinite(trial.readings[s]) for s in moved}
        return {s: noise.whitened(s, trial.time_s[read[s]], c[read[s]]) for s, c in moved.items()}

    return side_by_side(lambda pair: change(*pair), list(zip(log.trials, predictions, strict=True)))


def numerical_error(changes: Sequence[Mapping[str, Array]]) -> dict[str, float]:
    """Root mean square of the change by sensor, in sigma."""
    parts = {s: [c[s] for c in changes if s in c] for s in SENSORS}
    return {s: float(np.sqrt(np.mean(np.concatenate(p) ** 2))) for s, p in parts.items() if p}


def numerical_warnings(error: Mapping[str, float]) -> tuple[str, ...]:
    """A warning for every sensor for which the replay is too coarse."""
    return tuple(
        f"{sensor}: the numerical error of the replay is {in_sigma(value)}; gaps below "
        f"{in_sigma(np.hypot(1.0, value))} mean little here"
        for sensor, value in error.items()
        if value > NUMERICAL_ERROR_WARNED
    )
