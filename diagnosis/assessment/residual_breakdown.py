"""The residual broken down: by signal, by phase of the motion, by frequency, by depth, along time."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from diagnosis.criteria import (
    AFTER_REVERSAL_S,
    BANDS_HZ,
    SLIDING_MM_S,
    STRETCH_S,
    TURNING_DEG_S,
)
from diagnosis.log.rig_log import RigLog
from diagnosis.log.trial import SENSORS, Trial
from diagnosis.prepare.sensor_noise import Noise
from diagnosis.replay.replay import Prediction

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

_SMOOTH_S = 0.2


@dataclass(frozen=True, kw_only=True)
class ResidualBreakdown:
    """Root mean square of residual / sigma, by part; 1 is the noise floor.

    Attributes:
      band_hz: lowest and highest frequency, and the gap between them.
      depth_mm: median depth of trials, and their gap.
      time_s: trial, start and end of a stretch of 5 s, and the gap in it.
    """

    signal: dict[str, float]
    phase: dict[str, float]
    band_hz: list[tuple[float, float, float]]
    depth_mm: list[tuple[float, float]]
    time_s: list[tuple[str, float, float, float]]

    @property
    def worst(self) -> tuple[str, float]:
        """The stretch with the largest residual in words, and that residual / sigma."""
        name, begin, end, gap = max(self.time_s, key=lambda stretch: stretch[-1])
        return f"{name}, {begin:.0f}–{end:.0f} s", gap

    @property
    def worst_part(self) -> str:
        """The signal and the phase with the largest residual, in words."""
        signal = max(self.signal, key=lambda k: self.signal[k], default="")
        phase = max(self.phase, key=lambda k: self.phase[k], default="")
        return f"in {signal} while {phase}" if phase else f"in {signal}"


def base_rate(time_s: Array, base_deg: Array) -> Array:
    """Rate of the base, deg/s, (N,), from angles averaged over 0.2 s."""
    width = max(3, round(_SMOOTH_S / float(np.median(np.diff(time_s)))))
    padded = np.pad(base_deg, width, mode="edge")
    smooth = np.convolve(padded, np.ones(width) / width, "same")
    return np.asarray(np.gradient(smooth[width:-width], time_s))


def phases(trial: Trial) -> dict[str, Mask]:
    """Masks of a trial's samples: they may overlap."""
    time = trial["time_s"]
    rate = base_rate(time, trial["base_angle_deg"])
    turning = np.abs(rate) > TURNING_DEG_S
    speed = trial["speed_mm_s"]
    return {
        "turning": turning,
        "holding": ~turning,
        "reversal": _after_reversal(time, np.where(turning, np.sign(rate), 0.0)),
        "translating": np.abs(speed) > SLIDING_MM_S,
        "retracting": speed < -SLIDING_MM_S,
    }


def _after_reversal(time: Array, direction: Array) -> Mask:
    """Samples up to two seconds after the base began to turn the other way."""
    mask = np.zeros(time.size, bool)
    moving = np.flatnonzero(direction)
    changed = moving[1:][np.diff(direction[moving]) != 0]
    for i in changed:
        mask |= (time >= time[i]) & (time < time[i] + AFTER_REVERSAL_S)
    return mask


def residual_breakdown(log: RigLog, predictions: list[Prediction], noise: Noise) -> ResidualBreakdown:
    """The residual of predictions at the samples of the log, by part."""
    signal: dict[str, list[Array]] = {}
    phase: dict[str, list[Array]] = {}
    band: dict[tuple[float, float], list[float]] = {}
    depth: dict[float, list[Array]] = {}
    stretch: dict[tuple[str, float], list[Array]] = {}
    for trial, prediction in zip(log.trials, predictions, strict=True):
        masks = phases(trial)
        for sensor in SENSORS:
            if not trial.has(sensor):
                continue
            left = (trial[sensor] - prediction[sensor]) / noise[sensor]
            fine = np.isfinite(left)
            signal.setdefault(sensor, []).append(left[fine])
            for name, mask in masks.items():
                phase.setdefault(name, []).append(left[mask & fine])
            for key, value in _bands(trial["time_s"], np.where(fine, left, 0.0)).items():
                band.setdefault(key, []).append(value)
            middle = round(float(np.median(trial["inserted_mm"])), 1)
            depth.setdefault(middle, []).append(left[fine])
            for begin, own in _stretches(trial["time_s"][fine], left[fine]):
                stretch.setdefault((trial.name, begin), []).append(own)
    return ResidualBreakdown(
        signal={k: _rms(v) for k, v in signal.items()},
        phase={k: _rms(v) for k, v in phase.items() if sum(x.size for x in v)},
        band_hz=[(*k, float(np.sqrt(np.mean(v)))) for k, v in band.items()],
        depth_mm=[(k, _rms(depth[k])) for k in sorted(depth)],
        time_s=[(n, b, b + STRETCH_S, _rms(own)) for (n, b), own in stretch.items()],
    )


def _stretches(time: Array, left: Array) -> list[tuple[float, Array]]:
    """Residuals of every 5 s, with the time at which these begin."""
    begins = np.floor(time / STRETCH_S) * STRETCH_S
    return [(float(begin), left[begins == begin]) for begin in np.unique(begins)]


def _rms(parts: list[Array]) -> float:
    return float(np.sqrt(np.mean(np.concatenate(parts) ** 2)))


def _bands(time: Array, left: Array) -> dict[tuple[float, float], float]:
    """Power in each band over that of white noise of one unit."""
    step = float(np.median(np.diff(time)))
    power = np.abs(np.fft.rfft(left)) ** 2 / left.size
    frequency = np.fft.rfftfreq(left.size, step)
    inside = {b: (frequency >= b[0]) & (frequency < b[1]) for b in BANDS_HZ}
    return {b: float(power[mask].mean()) for b, mask in inside.items() if mask.any()}
