"""Where the gap lives: by signal, by phase of the motion, by frequency, by depth, along time."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from diagnosis.noise import Noise
from diagnosis.predict import Prediction
from diagnosis.rig_log import SENSORS, RigLog, Trial

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

BANDS_HZ = ((0.0, 0.1), (0.1, 1.0), (1.0, 10.0), (10.0, 1000.0))
_SMOOTH_S = 0.2
_TURNING_DEG_S = 1.0  # a base that is slower than this holds
_AFTER_REVERSAL_S = 2.0
_SLIDING_MM_S = 0.05
_STRETCH_S = 5.0


@dataclass(frozen=True, kw_only=True)
class Where:
    """Root mean square of residual over noise, by part; 1 is the noise floor.

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
        """The stretch with the largest gap in words, and that gap."""
        name, begin, end, gap = max(self.time_s, key=lambda stretch: stretch[-1])
        return f"{name}, {begin:.0f} to {end:.0f} s", gap


def base_rate(trial: Trial) -> Array:
    """Rate of the base, deg/s, (N,), from angles averaged over 0.2 s."""
    time = trial["time_s"]
    width = max(3, round(_SMOOTH_S / float(np.median(np.diff(time)))))
    padded = np.pad(trial["base_angle_deg"], width, mode="edge")
    smooth = np.convolve(padded, np.ones(width) / width, "same")
    return np.asarray(np.gradient(smooth[width:-width], time))


def phases(trial: Trial) -> dict[str, Mask]:
    """Masks of a trial's samples: they may overlap."""
    time, rate = trial["time_s"], base_rate(trial)
    turning = np.abs(rate) > _TURNING_DEG_S
    speed = trial["speed_mm_s"]
    return {
        "turning": turning,
        "holding": ~turning,
        "reversal": _after_reversal(time, np.where(turning, np.sign(rate), 0.0)),
        "translating": np.abs(speed) > _SLIDING_MM_S,
        "retracting": speed < -_SLIDING_MM_S,
    }


def _after_reversal(time: Array, direction: Array) -> Mask:
    """Samples up to two seconds after the base began to turn the other way."""
    mask = np.zeros(time.size, bool)
    moving = np.flatnonzero(direction)
    changed = moving[1:][np.diff(direction[moving]) != 0]
    for i in changed:
        mask |= (time >= time[i]) & (time < time[i] + _AFTER_REVERSAL_S)
    return mask


def locate(log: RigLog, predictions: list[Prediction], noise: Noise) -> Where:
    """Where the residual of a set of predictions lives."""
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
            missed = (trial[sensor] - prediction[sensor]) / noise[sensor]
            fine = np.isfinite(missed)
            signal.setdefault(sensor, []).append(missed[fine])
            for name, mask in masks.items():
                phase.setdefault(name, []).append(missed[mask & fine])
            for key, value in _bands(trial["time_s"], np.where(fine, missed, 0.0)).items():
                band.setdefault(key, []).append(value)
            middle = round(float(np.median(trial["inserted_mm"])), 1)
            depth.setdefault(middle, []).append(missed[fine])
            for begin, own in _stretches(trial["time_s"][fine], missed[fine]):
                stretch.setdefault((trial.name, begin), []).append(own)
    return Where(
        signal={k: _rms(v) for k, v in signal.items()},
        phase={k: _rms(v) for k, v in phase.items() if sum(x.size for x in v)},
        band_hz=[(*k, float(np.sqrt(np.mean(v)))) for k, v in band.items()],
        depth_mm=[(k, _rms(depth[k])) for k in sorted(depth)],
        time_s=[(n, b, b + _STRETCH_S, _rms(own)) for (n, b), own in stretch.items()],
    )


def _stretches(time: Array, missed: Array) -> list[tuple[float, Array]]:
    """Residuals of every 5 s, with the time at which these begin."""
    begins = np.floor(time / _STRETCH_S) * _STRETCH_S
    return [(float(begin), missed[begins == begin]) for begin in np.unique(begins)]


def _rms(parts: list[Array]) -> float:
    return float(np.sqrt(np.mean(np.concatenate(parts) ** 2)))


def _bands(time: Array, missed: Array) -> dict[tuple[float, float], float]:
    """Power in each band over that of white noise of one unit."""
    step = float(np.median(np.diff(time)))
    power = np.abs(np.fft.rfft(missed)) ** 2 / missed.size
    frequency = np.fft.rfftfreq(missed.size, step)
    inside = {b: (frequency >= b[0]) & (frequency < b[1]) for b in BANDS_HZ}
    return {b: float(power[mask].mean()) for b, mask in inside.items() if mask.any()}
