"""Replays trials: predicts the readings of rigs with given parameters.

The simulated needle is driven by the motion of the base, the depth, the free length and the axial
speed of each trial. All rigs of a trial are one batch of MuJoCo needles; rigs that differ only in
their sensors share a needle.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from diagnosis.cores import side_by_side
from diagnosis.log.nominal_rig import NominalRig
from diagnosis.log.trial import SENSORS
from diagnosis.prepare.low_band import low_passed
from diagnosis.prepare.noise.sensor_noise import Noise
from diagnosis.prepare.prepared_log import PreparedLog, PreparedTrial
from diagnosis.replay.interpolation import interpolated
from diagnosis.replay.past import schedule_with_past
from diagnosis.replay.resolution import FINE, Resolution
from diagnosis.replay.rig_parameters import NOMINAL, RigParameters, SmoothedReading
from diagnosis.replay.sensing.sensors import driven, reads_ahead, sensed
from models.errors import InvalidValue
from sim.needles.run import Run, SimulationFailed
from sim.simulation import simulate

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class Prediction:
    """Predicted readings of one rig in one trial: by sensor, at the samples, (N,)."""

    tip_angle_deg: Array
    base_torque_n_mm: Array

    def __getitem__(self, sensor: str) -> Array:
        readings: Array = getattr(self, sensor)
        return readings

    def rows(self, kept: NDArray[np.bool_]) -> "Prediction":
        """The prediction at some of its samples."""
        return Prediction(**{sensor: self[sensor][kept] for sensor in SENSORS})

    def at(self, wanted_s: Array, time_s: Array) -> "Prediction":
        """The prediction at other times, given the times of its samples."""
        return Prediction(**{s: interpolated(wanted_s, time_s, self[s]) for s in SENSORS})


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
    return _sensed(rigs, [runs[i] for i in each], trial)


def shape_of(
    nominal: NominalRig, trial: PreparedTrial, rig: RigParameters, resolution: Resolution = FINE
) -> Run:
    """The simulated run of one trial, at its own time steps, with the shape of the shaft."""
    run = _run(nominal, trial, [rig], resolution, keep_shape=True)[0]
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
            rig.setup(nominal, own, elements=elements, step_s=step_s)
            for rig, own in zip(rigs, inputs, strict=True)
        ]
        return simulate(setups, inputs, keep_shape=keep_shape, callback_alone=callback_alone)
    except InvalidValue as refused:
        if all(rig == NOMINAL for rig in rigs):
            raise  # it is a constant of the log
        raise SimulationFailed(f"a needle with these parameters cannot be built: {refused}") from refused


def _sensed(
    rigs: Sequence[RigParameters], runs: Sequence[Run], trial: PreparedTrial
) -> list[Prediction]:
    """Readings at the samples of a trial, by rig; as read where a sensor's clock is past the end of it.

    Args:
      runs: by rig, all with the same time steps.
    """
    at_s, steps_s = trial.time_s, runs[0].time_s
    shown = [
        sensed(rig, run.inputs, _tip_deg(rig, run), run.base_torque_n_mm, float(at_s[0]))
        for rig, run in zip(rigs, runs, strict=True)
    ]
    read = interpolated(at_s, steps_s, np.stack([signal for both in shown for signal in both], axis=-1))
    return [
        _as_read(rig, Prediction(tip_angle_deg=tip, base_torque_n_mm=torque), trial, steps_s)
        for rig, tip, torque in zip(rigs, read.T[::2], read.T[1::2], strict=True)
    ]


def _tip_deg(rig: RigParameters, run: Run) -> Array:
    """Angle of the tip, (N,); that of a run as seen from tissue which has turned in its holder, too."""
    turned = rig.free is not None and rig.free.grip_of_tissue
    return run.tip_deg + run.slip_deg if turned else run.tip_deg


def _as_read(
    rig: RigParameters, prediction: Prediction, trial: PreparedTrial, steps_s: Array
) -> Prediction:
    """A prediction with the jumps of sensors, and with what was read where a clock is past the end.

    Of readings that were smoothed, it is that in their low band.
    """
    shown, at_s = {sensor: prediction[sensor] for sensor in SENSORS}, trial.time_s
    for jump in (one for one in rig.jumps if one.sensor in shown):
        shown[jump.sensor] = shown[jump.sensor] + jump.size * (at_s >= jump.time_s)
    for sensor, ahead in reads_ahead(rig, steps_s, at_s).items():
        if trial.has(sensor):
            read = trial.readings[sensor]
            shown[sensor] = np.where(ahead & np.isfinite(read), read, shown[sensor])
    for sensor, corner_hz in trial.smoothed_above_hz.items():
        own = next((one for one in rig.smoothed if one.sensor == sensor), SmoothedReading(sensor=sensor))
        coefficients = own.second_coefficient, own.fourth_coefficient
        shown[sensor] = low_passed(at_s, shown[sensor], corner_hz, *coefficients)
    return Prediction(**shown)
