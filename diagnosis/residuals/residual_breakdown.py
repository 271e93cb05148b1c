"""The residual broken down: by signal, by phase of the motion, by frequency, by depth, along time."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from diagnosis.criteria.residuals import BANDS_HZ, STRETCH_S
from diagnosis.in_sigma import in_sigma
from diagnosis.residuals.motion import phases
from diagnosis.residuals.trial_residual import TrialResidual

Array = NDArray[np.float64]


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
    def largest(self) -> str:
        """The signal and the phase with the largest residual: the words of every report and advice."""
        signal, phase = _first(self.signal), _first(self.phase)
        words = f"largest in {signal} ({in_sigma(self.signal[signal])})" if signal else "nowhere"
        if not phase:
            return words
        when = "after a reversal" if phase == "reversal" else f"while {phase}"
        return f"{words} and {when} ({in_sigma(self.phase[phase])})"


def band_name(low_hz: float, high_hz: float) -> str:
    """A band of frequencies in words; the last one ends where the samples do."""
    return f"above {low_hz:g} Hz" if high_hz == BANDS_HZ[-1][1] else f"{low_hz:g} to {high_hz:g} Hz"


def _first(parts: Mapping[str, float]) -> str:
    """The part with the largest residual; empty without parts."""
    return max(parts, key=lambda part: parts[part], default="")


def residual_breakdown(residuals: Sequence[TrialResidual]) -> ResidualBreakdown:
    """Residuals of the trials of a log, by part."""
    signal: dict[str, list[Array]] = {}
    phase: dict[str, list[Array]] = {}
    band: dict[tuple[float, float], list[float]] = {}
    depth: dict[float, list[Array]] = {}
    stretch: dict[tuple[str, float], list[Array]] = {}
    for residual in residuals:
        trial, masks = residual.trial, phases(residual.trial)
        for sensor, left in residual.left.items():
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
    """Residuals in intervals of 5 s, with their starting times."""
    begins = np.floor(time / STRETCH_S) * STRETCH_S
    return [(float(begin), left[begins == begin]) for begin in np.unique(begins)]


def _rms(parts: list[Array]) -> float:
    return float(np.sqrt(np.mean(np.concatenate(parts) ** 2)))


def _bands(time: Array, left: Array) -> dict[tuple[float, float], float]:
    """Power in each band / that of white noise of one unit."""
    step = float(np.median(np.diff(time)))
    power = np.abs(np.fft.rfft(left)) ** 2 / left.size
    frequency = np.fft.rfftfreq(left.size, step)
    inside = {b: (frequency >= b[0]) & (frequency < b[1]) for b in BANDS_HZ}
    return {b: float(power[mask].mean()) for b, mask in inside.items() if mask.any()}
