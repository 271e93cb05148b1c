"""Readings in coarse steps: the rounding error is constant while the reading is.

Rounding to steps of q adds noise of q / sqrt(12). If the signal moves across steps, or noise of at least
half a step moves it, this error is as white as other noise. Otherwise the error is
constant, up to q / 2: a hundred readings tell no more than one. So of constant readings, one in
half a second counts. This includes the base: while a coarse encoder shows no change, base,
tip and torque all have the error of the motion that it does not show.
"""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from diagnosis.criteria.faults import FROZEN_LEAST_RUN
from diagnosis.criteria.prepare import (
    COARSE_LEAST_KINDS,
    COARSE_LEAST_RUNS,
    COARSE_STEP_SIGMA,
    HELD_COUNTED_S,
    HELD_S,
    HELD_STEPS,
    SHAKEN_STEP_SIGMA,
)
from diagnosis.log.faults.scatter import quantum
from diagnosis.log.nominal_rig import NominalRig
from diagnosis.log.trial import SENSORS, Trial

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

_BASE = "base_angle_deg"
_WHOLE, _MOSTLY = 0.1, 0.9  # readings are rounded to decimals besides; outliers may be off the steps


def steps_of(rig: NominalRig, trials: Sequence[Trial]) -> dict[str, float]:
    """The steps of columns with coarse readings: larger than steps that noise would hide."""
    found = {}
    for column, claim in rig.sensors.by_column().items():
        parts = [trial[column] for trial in trials if trial.has(column)]
        step = min((size for values in parts if (size := quantum(values)) > 0), default=0.0)
        coarse = step > COARSE_STEP_SIGMA * claim > 0
        if coarse and (sum(map(_short_runs, parts)) >= COARSE_LEAST_RUNS or _jumps(parts, step)):
            found[column] = step
    return found


def _short_runs(values: Array) -> int:
    """Number of short runs of equal readings; an exact reading changes at every sample, or rests."""
    finite = values[np.isfinite(values)]
    lengths = np.diff(np.flatnonzero(np.diff(finite, prepend=np.nan, append=np.nan) != 0))
    return int(np.count_nonzero((lengths > 1) & (lengths <= FROZEN_LEAST_RUN)))


def _jumps(parts: Sequence[Array], step: float) -> bool:
    """Whether readings change by several multiples of a step; those of an exact ramp change by one."""
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
    """Readings of the sensors, (N,) each; of those that rounding holds constant, only some are kept."""
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
    """Mask where a reading, averaged over 0.1 s, stays within a step for longer than that."""
    width = max(round(HELD_S / float(np.median(np.diff(trial["time_s"])))), 2)
    read = pd.Series(trial[column]).interpolate(limit_direction="both")

    def rolled(values: "pd.Series[float]") -> Any:
        return values.rolling(width, center=True, min_periods=1)

    means = rolled(read).mean()
    ranges = rolled(means).max() - rolled(means).min()
    return np.asarray(rolled(ranges).min() <= HELD_STEPS * step)


def _counted(trial: Trial) -> Mask:
    """Mask of one sample in every half second."""
    part = np.floor((trial["time_s"] - trial["time_s"][0]) / HELD_COUNTED_S)
    return np.asarray(np.diff(part, prepend=-1.0) > 0)
