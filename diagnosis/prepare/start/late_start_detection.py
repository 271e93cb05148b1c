"""Detects trials that began late: twisted at rest, or moving.

If a needle starts from rest, tip and base have the same angle at the first sample: twist diffuses
along the shaft, which takes time. So the angle at which the tip starts is the intercept of a parabola
through the first readings minus the nominal prediction, which begins untwisted. An offset of the sensor
looks the same, but is equal in all trials. A twist differs from trial to trial, and carries a torque,

    twist kappa / (free + inserted)  <=  torque  <=  twist kappa / free,

if it has one sign along the shaft. The torque alone shows a late start only if the base rests
or the tip is not measured: with friction it may jump if the base moves from the first sample on.
And nobody begins a turn somewhere in the middle: where the base turns at the first sample, and not at
its zero, the recording began late, however untwisted the needle may be just then.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from diagnosis.criteria.prepare import (
    START_DECAYS,
    START_FROM_REST,
    START_LEAST_SIGMA,
    START_LOOK_S,
    START_MOST_UNUSED,
    START_MOVING_DEG_S,
    START_OFF_ZERO_DEG,
    START_OUTLIER_SIGMA,
    START_SIGMA,
    START_TORQUE_FACTOR,
)
from diagnosis.criteria.residuals import TURNING_DEG_S
from diagnosis.log.nominal_rig import NominalRig
from diagnosis.log.rig_log import RigLog
from diagnosis.log.trial import SENSORS, Trial
from diagnosis.prepare.needle_memory import time_constant_s
from diagnosis.prepare.noise.sensor_noise import Noise
from diagnosis.prepare.prepared_log import PreparedLog, PreparedTrial
from diagnosis.prepare.start.late_start import LateStart

Array = NDArray[np.float64]

_TIP, _TORQUE = "tip_angle_deg", "base_torque_n_mm"
_FEWEST = 10  # readings that a parabola is laid through


@dataclass(frozen=True, kw_only=True)
class _Offset:
    """The excess of a sensor's reading at the start over the nominal rig, and its threshold."""

    off_sigma: float = 0.0
    limit_sigma: float = np.inf

    def beyond(self, other: float) -> bool:
        return abs(self.off_sigma - other) > self.limit_sigma


def with_late_starts(
    log: PreparedLog, residuals: Mapping[str, Sequence[Array]], noise: Noise
) -> PreparedLog:
    """The log with late trials marked, and without their first sensor readings.

    Args:
      residuals: measured minus nominal, by sensor, for the trials that have it, in their order.
    """
    tips = _offsets(log.trials, _TIP, residuals, noise)
    torques = _offsets(log.trials, _TORQUE, residuals, noise)
    each = list(zip(log.trials, tips, torques, strict=True))
    loaded = [_carries_torque(log.rig, trial, tip, torque, noise) for trial, tip, torque in each]
    shared = {
        sensor: _shared([own for own, twisted in zip(offsets, loaded, strict=True) if not twisted])
        for sensor, offsets in ((_TIP, tips), (_TORQUE, torques))
    }
    trials = [
        _late(log.rig, trial, tip, torque, shared, noise)
        if twisted or _differs(trial, tip, torque, shared) or _begins_under_way(trial)
        else trial
        for (trial, tip, torque), twisted in zip(each, loaded, strict=True)
    ]
    return replace(log, trials=tuple(trials))


def begun_as(log: PreparedLog, other: PreparedLog) -> PreparedLog:
    """The log with those trials marked that are in another version of it."""
    each = zip(log.trials, other.trials, strict=True)
    trials = [
        begun_late(log.rig, own, marked.late_start.twist_deg) if marked.late_start else own
        for own, marked in each
    ]
    return replace(log, trials=tuple(trials))


def without_unused(log: RigLog, begun: PreparedLog) -> RigLog:
    """The log without readings that are not used: where trials began late, and after uncertain gaps."""
    each = zip(log.trials, begun.trials, strict=True)
    return replace(log, trials=tuple(_without_unused(trial, own) for trial, own in each))


def _without_unused(trial: Trial, begun: PreparedTrial) -> Trial:
    unused_s = begun.late_start.unused_s if begun.late_start else 0.0
    unused = trial["time_s"] < trial["time_s"][0] + unused_s
    if begun.after_gaps is not None:
        unused |= begun.after_gaps[begun.logged]
    table = trial.table.copy()
    table.loc[unused, [sensor for sensor in SENSORS if sensor in table]] = np.nan
    return replace(trial, table=table)


def _differs(trial: PreparedTrial, tip: _Offset, torque: _Offset, shared: Mapping[str, float]) -> bool:
    """Whether a trial has another offset at the start than the others, or than at rest."""
    off = torque.beyond(shared[_TORQUE])
    if not trial.has(_TIP):
        return off
    twisted = (tip.off_sigma - shared[_TIP]) * (torque.off_sigma - shared[_TORQUE]) < 0.0
    a_little = abs(tip.off_sigma - shared[_TIP]) > tip.limit_sigma / 2
    rests = abs(start_rate_deg_s(trial)) < TURNING_DEG_S
    return tip.beyond(shared[_TIP]) or (off and twisted and a_little and rests)


def _begins_under_way(trial: PreparedTrial) -> bool:
    """Whether the base turns at the first sample already, somewhere else than at its zero."""
    off_zero = abs(float(trial.base_motion_deg[0])) > START_OFF_ZERO_DEG
    rate = start_rate_deg_s(trial)
    from_rest = start_rate_deg_s(trial, degree=2) * np.sign(rate) < START_FROM_REST * abs(rate)
    return off_zero and abs(rate) > START_MOVING_DEG_S and not from_rest


def _carries_torque(
    rig: NominalRig, trial: PreparedTrial, tip: _Offset, torque: _Offset, noise: Noise
) -> bool:
    """Whether the offsets of both sensors are those of a twisted shaft: all trials may begin so."""
    if not (tip.beyond(0.0) and torque.beyond(0.0)):
        return False
    free_mm, inserted_mm = float(trial.free_mm[0]), float(trial.inserted_mm[0])
    twist_rad = -np.radians(tip.off_sigma * noise[_TIP])
    per_torque = twist_rad * rig.rigidity_n_mm2 / (torque.off_sigma * noise[_TORQUE])
    factor = START_TORQUE_FACTOR
    return bool(free_mm / factor <= per_torque <= factor * (free_mm + inserted_mm))


def _offsets(
    trials: Sequence[PreparedTrial],
    sensor: str,
    residuals: Mapping[str, Sequence[Array]],
    noise: Noise,
) -> list[_Offset]:
    """Offsets of all trials; 0 for trials without the sensor."""
    left = iter(residuals.get(sensor, ()))
    return [
        _offset(trial.time_s - trial.time_s[0], next(left), noise[sensor])
        if trial.has(sensor)
        else _Offset()
        for trial in trials
    ]


def _offset(time_s: Array, residual: Array, sigma: float) -> _Offset:
    """Intercept of a parabola through the first readings, without outliers."""
    first = slice(0, max(_FEWEST, int(np.searchsorted(time_s, START_LOOK_S))))
    read = np.isfinite(residual[first])
    time, left = time_s[first][read], residual[first][read]
    for _ in range(2):
        if time.size < _FEWEST // 2:
            return _Offset()
        basis, root = np.linalg.qr(np.vander(time / START_LOOK_S, 3, increasing=True))
        fitted = basis @ (basis.T @ left)
        near = np.abs(left - fitted) <= START_OUTLIER_SIGMA * sigma
        inverse = np.linalg.inv(root)
        value, spread = float((inverse @ (basis.T @ left))[0]), float(np.linalg.norm(inverse[0]))
        if near.all():
            break
        time, left = time[near], left[near]
    limit = max(START_SIGMA * spread, START_LEAST_SIGMA)
    return _Offset(off_sigma=value / sigma, limit_sigma=limit)


def _shared(offsets: Sequence[_Offset]) -> float:
    """The offset that most trials share, at least two; else 0."""
    measured = [own for own in offsets if np.isfinite(own.limit_sigma)]
    best, most = 0.0, sum(not own.beyond(0.0) for own in measured)
    for one in measured:
        alike = [own.off_sigma for own in measured if not own.beyond(one.off_sigma)]
        if len(alike) > max(most, 1):
            best, most = float(np.median(alike)), len(alike)
    return best


def _late(
    rig: NominalRig,
    trial: PreparedTrial,
    tip: _Offset,
    torque: _Offset,
    shared: Mapping[str, float],
    noise: Noise,
) -> PreparedTrial:
    if trial.has(_TIP):
        twist_deg = (shared[_TIP] - tip.off_sigma) * noise[_TIP]
    else:
        torque_n_mm = (torque.off_sigma - shared[_TORQUE]) * noise[_TORQUE]
        length_mm = float(trial.free_mm[0] + 0.5 * trial.inserted_mm[0])
        twist_deg = float(np.degrees(torque_n_mm * length_mm / rig.rigidity_n_mm2))
    return begun_late(rig, trial, float(twist_deg))


def begun_late(rig: NominalRig, trial: PreparedTrial, twist_deg: float) -> PreparedTrial:
    """The trial with a past, and without the readings of a time in which that is not known well enough.

    Args:
      twist_deg: lead of the base over the tip at the first sample.
    """
    unused_s = min(_forgotten_s(rig, trial), START_MOST_UNUSED * float(np.ptp(trial.time_s)))
    unused = trial.time_s < trial.time_s[0] + unused_s
    start = LateStart(twist_deg=twist_deg, rate_deg_s=start_rate_deg_s(trial), unused_s=unused_s)
    readings = {s: np.where(unused, np.nan, values) for s, values in trial.readings.items()}
    return replace(trial, late_start=start, readings=readings)


def start_rate_deg_s(trial: PreparedTrial, degree: int = 1) -> float:
    """Rate of the base at the first sample, by a line through a tenth of a second, or a parabola."""
    first = slice(0, max(_FEWEST // 2, int(np.searchsorted(trial.time_s - trial.time_s[0], 0.1))))
    time_s = trial.time_s[first] - trial.time_s[0]
    return float(np.polyfit(time_s, trial.base_motion_deg[first], degree)[-2])


def _forgotten_s(rig: NominalRig, trial: PreparedTrial) -> float:
    """Time after which all but the slowest mode of the nominal needle have decayed, s."""
    inserted_mm, free_mm = float(trial.inserted_mm[0]), float(trial.free_mm[0])
    return START_DECAYS * time_constant_s(rig, inserted_mm, free_mm, mode=2)
