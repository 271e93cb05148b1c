"""Replays trials: predicts the readings of rigs with given parameters.

The simulated needle is driven by the motion of the base, the depth, the free length and the axial
speed of each trial. All rigs of a trial are one batch of MuJoCo needles; rigs that differ only in
their sensors share a needle.
"""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from diagnosis.cores import side_by_side
from diagnosis.log.nominal_rig import NominalRig
from diagnosis.log.trial import SENSORS
from diagnosis.prepare.noise.sensor_noise import Noise
from diagnosis.prepare.prepared_log import PreparedLog, PreparedTrial
from diagnosis.replay.past import schedule_with_past
from diagnosis.replay.prediction import Prediction, sensed_at_samples
from diagnosis.replay.resolution import FINE, Resolution
from diagnosis.replay.rig_parameters import NOMINAL, RigParameters
from diagnosis.replay.sensing.sensors import driven
from models.errors import InvalidValue
from sim.needles.run import Run, SimulationFailed
from sim.simulation import simulate

Array = NDArray[np.float64]


def replay(
    log: PreparedLog, rig: RigParameters = NOMINAL, resolution: Resolution = FINE
) -> list[Prediction]:
    """Predictions of every trial by one rig, by default the nominal one.

    Raises:
      SimulationFailed: the rig cannot be simulated.
    """
    return side_by_side(lambda trial: predict(log.rig, trial, [rig], resolution)[0], log.trials)


def predict(
    nominal: NominalRig,
    trial: PreparedTrial,
    rigs: Sequence[RigParameters],
    resolution: Resolution = FINE,
    *,
    callback_alone: bool = False,
) -> list[Prediction]:
    """Predictions of one trial by several rigs, in their order.

    Args:
      callback_alone: without MuJoCo's steps, for finite differences.

    Raises:
      SimulationFailed: one of them cannot be simulated.
    """
    rigs = [rig.on_trial(trial.name) for rig in rigs]
    number: dict[RigParameters, int] = {}
    each = [number.setdefault(rig.without_sensors, len(number)) for rig in rigs]
    runs = _run(nominal, trial, list(number), resolution, callback_alone=callback_alone)
    return sensed_at_samples(rigs, [runs[i] for i in each], trial)


def shape_of(nominal: NominalRig, trial: PreparedTrial, rig: RigParameters) -> Run:
    """The simulated run of one trial, at its own time steps, with the shape of the shaft."""
    run = _run(nominal, trial, [rig], FINE, keep_shape=True)[0]
    return run.since(float(trial.time_s[0]))


def residuals(trial: PreparedTrial, prediction: Prediction, noise: Noise) -> Array:
    """Measured minus predicted / sigma, weighted and whitened, one sensor after another, (M,)."""
    return residuals_of_each(trial, [prediction], noise)[0]


def residuals_of_each(
    trial: PreparedTrial, predictions: Sequence[Prediction], noise: Noise
) -> list[Array]:
    """The same of several predictions, which are whitened together, (M,) each."""
    parts = [_of_sensor(trial, sensor, predictions, noise) for sensor in SENSORS if trial.has(sensor)]
    each = zip(*parts, strict=True) if parts else [() for _ in predictions]
    return [np.concatenate([np.zeros(0), *own]) for own in each]


def _of_sensor(
    trial: PreparedTrial, sensor: str, predictions: Sequence[Prediction], noise: Noise
) -> list[Array]:
    read = np.isfinite(trial.readings[sensor])
    predicted = np.stack([prediction[sensor] for prediction in predictions], axis=1)
    left = (trial.readings[sensor][:, None] - predicted) / noise[sensor]
    if sensor in trial.weights:
        left *= trial.weights[sensor][:, None]
    return list(noise.whitened(sensor, trial.time_s[read], left[read]).T)


def _run(
    nominal: NominalRig,
    trial: PreparedTrial,
    rigs: Sequence[RigParameters],
    resolution: Resolution,
    *,
    keep_shape: bool = False,
    callback_alone: bool = False,
) -> list[Run]:
    step_s, elements = resolution.step_of(trial), resolution.elements
    start_s = float(trial.time_s[0])
    inputs = []
    for rig in rigs:
        logged = schedule_with_past(rig, trial)
        follows = rig.free is not None and rig.free.follows_torque
        torque = np.interp(logged.time_s, trial.time_s, trial.smooth_torque_n_mm) if follows else None
        inputs.append(driven(rig, logged, start_s, torque))
    try:
        setups = [
            rig.setup(
                nominal,
                own,
                elements=elements,
                step_s=step_s,
                past_s=start_s - float(own.time_s[0]),
            )
            for rig, own in zip(rigs, inputs, strict=True)
        ]
        return simulate(setups, inputs, keep_shape=keep_shape, callback_alone=callback_alone)
    except InvalidValue as refused:
        if all(rig == NOMINAL for rig in rigs):
            raise  # it is a constant of the log
        raise SimulationFailed(f"a needle with these parameters cannot be built: {refused}") from refused
