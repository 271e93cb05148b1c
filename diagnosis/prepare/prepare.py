"""Prepares a log for replay: fills gaps and estimates the motion of the base."""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from diagnosis.log.nominal_rig import NominalRig
from diagnosis.log.rig_log import RigLog
from diagnosis.log.trial import BASE, SENSORS, Trial
from diagnosis.prepare.motion.base_smoothing import smooth_base
from diagnosis.prepare.motion.gap_filling import fill_gaps
from diagnosis.prepare.motion.inertia import inertia_torque
from diagnosis.prepare.needle_memory import time_constant_s
from diagnosis.prepare.noise.rounding import rounded_noise, steps_of, without_repeats
from diagnosis.prepare.noise.sensor_noise import base_noise_deg
from diagnosis.prepare.prepared_log import Mask, PreparedLog, PreparedTrial

Array = NDArray[np.float64]


def prepare(log: RigLog) -> tuple[PreparedLog, float]:
    """The log to replay, and the noise of the base's encoder that was removed, deg."""
    steps = steps_of(log.rig, log.trials)
    rounded = rounded_noise(log.rig, steps)
    sigma_deg = rounded.get(BASE) or base_noise_deg(log.rig, log.trials)
    filled = [fill_gaps(trial, sigma_deg, _memory_s(log.rig, trial)) for trial in log.trials]
    sigma_deg = rounded.get(BASE) or base_noise_deg(log.rig, filled)
    trials = []
    for trial, rows in zip(log.trials, filled, strict=True):
        smooth = _prepared(trial, rows, sigma_deg)
        counted = without_repeats(rows, log.rig, steps)
        ready = replace(smooth, readings=counted, smoothed_above_hz=log.smoothed_above_hz)
        trials.append(_with_inertia(ready, log.rig))
    prepared = PreparedLog(
        rig=log.rig,
        trials=tuple(trials),
        rounded=rounded,
        means_of=log.means_of,
        noise_left=log.noise_left,
    )
    return prepared, sigma_deg


def _memory_s(rig: NominalRig, trial: Trial) -> float:
    """Slowest time constant of the nominal needle in a trial, s."""
    deepest = int(np.argmax(trial["inserted_mm"]))
    inserted_mm, free_mm = (float(trial[name][deepest]) for name in ("inserted_mm", "free_mm"))
    return time_constant_s(rig, inserted_mm, free_mm, mode=1)


def _with_inertia(trial: PreparedTrial, rig: NominalRig) -> PreparedTrial:
    """The trial with the share of inertia in its torque, if it measured the torque."""
    if not trial.has("base_torque_n_mm"):
        return trial
    length_mm = float(np.max(trial.free_mm + trial.inserted_mm))
    found = inertia_torque(
        rig,
        trial.time_s,
        trial.base_motion_deg,
        length_mm,
        rig.sensors.base_torque_noise_n_mm,
    )
    return replace(trial, inertia=found)


def _prepared(trial: Trial, filled: Trial, sigma_deg: float) -> PreparedTrial:
    return PreparedTrial(
        name=trial.name,
        time_s=filled["time_s"],
        base_motion_deg=smooth_base(filled["time_s"], filled["base_angle_deg"], sigma_deg),
        inserted_mm=filled["inserted_mm"],
        free_mm=filled["free_mm"],
        speed_mm_s=filled["speed_mm_s"],
        tip_torque_n_mm=filled["tip_torque_n_mm"] if filled.has("tip_torque_n_mm") else None,
        readings={sensor: filled[sensor] for sensor in SENSORS if filled.has(sensor)},
        logged=np.isin(filled["time_s"], trial["time_s"]),
        after_gaps=_unread(filled),
        time_errors_s=_time_errors_s(trial, filled["time_s"]),
    )


def _unread(trial: Trial) -> Mask:
    """Mask of rows without a reading of any sensor, (N,)."""
    read = [np.isfinite(trial[sensor]) for sensor in SENSORS if trial.has(sensor)]
    return ~np.any(read, axis=0) if read else np.zeros(trial["time_s"].size, bool)


def _time_errors_s(trial: Trial, time_s: Array) -> Array | None:
    """What times may be off by, by example, (K, N); None: they are exact."""
    rows = trial.file_rows
    if rows.errors_s is None:
        return None
    return np.stack([np.interp(time_s, rows.taken_s, own) for own in rows.errors_s])
