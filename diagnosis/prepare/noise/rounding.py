"""Readings in coarse steps: the error of rounding stands still while the reading does.

Rounding to steps of q adds q / sqrt(12) of noise. Where a signal moves across steps, or noise of half a
step and more shakes it across, that is as white as other noise. Where neither is so, the error is one
constant, up to q / 2: a hundred readings say no more than one. So of readings that stand still, one in
half a second counts. The base is a reading too: while a coarse encoder stands still, base,
tip and torque are all off by what it does not show.
"""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from diagnosis.criteria import (
    COARSE_LEAST_KINDS,
    COARSE_LEAST_RUNS,
    COARSE_STEP_SIGMA,
    FROZEN_LEAST_RUN,
    HELD_COUNTED_S,
    HELD_S,
    HELD_STEPS,
    SHAKEN_STEP_SIGMA,
)
from diagnosis.log.nominal_rig import NominalRig
from diagnosis.log.sensor_faults import quantum
from diagnosis.log.trial import SENSORS, Trial

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

_BASE = "base_angle_deg"
_WHOLE, _MOSTLY = 0.1, 0.9  # readings are rounded to decimals besides; outliers may be off the steps


def steps_of(rig: NominalRig, trials: Sequence[Trial]) -> dict[str, float]:
    """The steps of columns whose readings are coarse: larger than noise would hide."""
    found = {}
    for column, claim in rig.sensors.by_column().items():
        parts = [trial[column] for trial in trials if trial.has(column)]
        step = min((size for values in parts if (size := quantum(values)) > 0), default=0.0)
        coarse = step > COARSE_STEP_SIGMA * claim > 0
        if coarse and (sum(map(_short_runs, parts)) >= COARSE_LEAST_RUNS or _jumps(parts, step)):
            found[column] = step
    return found


def _short_runs(values: Array) -> int:
    """How often a reading stands for some samples and moves on; an exact one moves or stands."""
    finite = values[np.isfinite(values)]
    lengths = np.diff(np.flatnonzero(np.diff(finite, prepend=np.nan, append=np.nan) != 0))
    return int(np.count_nonzero((lengths > 1) & (lengths <= FROZEN_LEAST_RUN)))


def _jumps(parts: Sequence[Array], step: float) -> bool:
    """Whether readings move by several multiples of a step; those of an exact ramp by one."""
    moved = np.abs(np.concatenate([np.diff(part[np.isfinite(part)]) for part in parts])) / step
    whole = np.rint(moved)
    near = float(np.mean(np.abs(moved - whole) < _WHOLE))
    return near > _MOSTLY and np.unique(whole[whole > 0]).size >= COARSE_LEAST_KINDS


def rounded_noise(rig: NominalRig, steps: Mapping[str, float]) -> dict[str, float]:
    """Standard deviations of coarse columns, with the noise of rounding."""
    claims = rig.sensors.by_column()
    return {
        column: float(np.hypot(claims[column], step / np.sqrt(12))) for column, step in steps.items()
    }


def without_repeats(trial: Trial, rig: NominalRig, steps: Mapping[str, float]) -> dict[str, Array]:
    """Readings of the sensors, (N,) each; of those that stand still for rounding, one of many counts."""
    claims = rig.sensors.by_column()
    still = {c: _held(trial, c, step) for c, step in steps.items() if _standing(c, step, claims)}
    everywhere = still.get(_BASE, np.zeros(trial["time_s"].size, bool))
    return {
        sensor: np.where(
            (everywhere | still.get(sensor, False)) & ~_counted(trial), np.nan, trial[sensor]
        )
        for sensor in SENSORS
        if trial.has(sensor)
    }


def _standing(column: str, step: float, claims: Mapping[str, float]) -> bool:
    """Whether noise is too small to shake readings across the steps."""
    return step > SHAKEN_STEP_SIGMA * claims[column]


def _held(trial: Trial, column: str, step: float) -> Mask:
    """Where a reading, averaged over a tenth of a second, stays within a step for longer than that."""
    width = max(round(HELD_S / float(np.median(np.diff(trial["time_s"])))), 2)
    read = pd.Series(trial[column]).interpolate(limit_direction="both")

    def rolled(values: "pd.Series[float]") -> Any:
        return values.rolling(width, center=True, min_periods=1)

    means = rolled(read).mean()
    ranges = rolled(means).max() - rolled(means).min()
    return np.asarray(rolled(ranges).min() <= HELD_STEPS * step)


def _counted(trial: Trial) -> Mask:
    """One sample in every half of a second."""
    part = np.floor((trial["time_s"] - trial["time_s"][0]) / HELD_COUNTED_S)
    return np.asarray(np.diff(part, prepend=-1.0) > 0)
