"""Predicted readings: what the sensors of a rig show of a simulated run, at the samples of a trial.

Where nobody knows what a sensor showed, since its clock is past the end of the run or its filter still
shows what was before it, the prediction is what was read. Where readings were smoothed after recording,
it is theirs in the low band.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from diagnosis.log.trial import SENSORS, TORQUE
from diagnosis.prepare.low_band import low_passed
from diagnosis.prepare.prepared_log import PreparedTrial
from diagnosis.replay.interpolation import interpolated
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.replay.sensing.reading_errors import SmoothedReading
from diagnosis.replay.sensing.sensors import reads_ahead, sensed, shows_before
from sim.needles.run import Run

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


def sensed_at_samples(
    rigs: Sequence[RigParameters], runs: Sequence[Run], trial: PreparedTrial
) -> list[Prediction]:
    """Readings at the samples of a trial, by rig; as read where a sensor's clock is past the end of it.

    Args:
      runs: by rig, all with the same time steps.
    """
    at_s, steps_s = trial.time_s, runs[0].time_s
    start_s = float(at_s[0])
    shown = [
        sensed(
            rig, run.inputs, _tip_deg(rig, run), run.base_torque_n_mm, start_s, _clocks_ran_s(rig, trial)
        )
        for rig, run in zip(rigs, runs, strict=True)
    ]
    read = interpolated(at_s, steps_s, np.stack([signal for both in shown for signal in both], axis=-1))
    return [
        _as_read(rig, Prediction(tip_angle_deg=tip, base_torque_n_mm=torque), trial, steps_s)
        for rig, tip, torque in zip(rigs, read.T[::2], read.T[1::2], strict=True)
    ]


def _clocks_ran_s(rig: RigParameters, trial: PreparedTrial) -> dict[str, float]:
    """For how long clocks of sensors ran before the trial, by sensor."""
    return {one.sensor: one.before_s for one in rig.clock_starts if one.trial == trial.name}


def _tip_deg(rig: RigParameters, run: Run) -> Array:
    """Angle of the tip, (N,); that of a run as seen from tissue which has turned in its holder, too."""
    turned = rig.free is not None and rig.free.grip.of_tissue
    return run.tip_deg + run.shaft_deg - run.base_deg if turned else run.tip_deg


def _as_read(
    rig: RigParameters, prediction: Prediction, trial: PreparedTrial, steps_s: Array
) -> Prediction:
    """A prediction with the jumps of sensors, and with what was read where nobody knows what was shown.

    A clock is past the end of a trial, or a filter shows what was before a trial that began late. Of
    readings that were smoothed, it is that in their low band.
    """
    shown, at_s = {sensor: prediction[sensor] for sensor in SENSORS}, trial.time_s
    for jump in (one for one in rig.jumps if one.sensor in shown):
        shown[jump.sensor] = shown[jump.sensor] + jump.size * (at_s >= jump.time_s)
    unknown = list(reads_ahead(rig, steps_s, at_s, _clocks_ran_s(rig, trial)).items())
    if trial.late_start is not None:
        unknown.append((TORQUE, shows_before(rig, at_s)))
    for sensor, rows in unknown:
        if trial.has(sensor):
            read = trial.readings[sensor]
            shown[sensor] = np.where(rows & np.isfinite(read), read, shown[sensor])
    for sensor, corner_hz in trial.smoothed_above_hz.items():
        own = next((one for one in rig.smoothed if one.sensor == sensor), SmoothedReading(sensor=sensor))
        coefficients = own.second_coefficient, own.fourth_coefficient
        shown[sensor] = low_passed(at_s, shown[sensor], corner_hz, *coefficients)
    return Prediction(**shown)
