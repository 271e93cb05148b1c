"""Averages logs with more than 220 samples per second to about 100: as much is known, ten times faster.

The motion of a needle takes a hundredth of a second and longer, and a replay takes a step per sample.
Means over windows of a hundredth of a second keep the information: the mean of n samples with white
noise has the standard deviation sigma / sqrt(n). The mean response in a window belongs to the mean
of its inputs, so base angle, lengths and torques are all averaged. The first and the last sample are
kept, so that the motion of the base begins and ends where it did; their sensor readings are left out,
and those of the last window, which may be a part of one: its motion is noisier.
Where trials were recorded at quite different rates, all stay as they are: means of one window would have
different noise in each, or none at all in a slow one.
Of readings in coarse steps, whose error is that of rounding and lasts, a mean is no better than the
median, which is on a step.
"""

import math
from collections.abc import Collection
from dataclasses import replace

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from diagnosis.criteria.prepare import (
    ALIKE_RATES,
    AVERAGED_ABOVE_HZ,
    AVERAGED_LEAST_SHARE,
    AVERAGING_S,
)
from diagnosis.log.rig_log import RigLog
from diagnosis.log.trial import SENSORS, Trial
from diagnosis.prepare.noise.rounding import steps_of

Array = NDArray[np.float64]


def averaged(log: RigLog) -> RigLog:
    """The log with means over windows as samples, if it has more samples than are of use."""
    step_s = float(np.median(np.concatenate([np.diff(trial["time_s"]) for trial in log.trials])))
    count = int(AVERAGING_S / step_s + 1e-6)
    if step_s * AVERAGED_ABOVE_HZ >= 1 or count < 2 or _at_different_rates(log):
        return log
    said = (
        f"{1 / step_s:.0f} samples a second: means of {count} samples are diagnosed; predictions in the "
        "report are at the samples of the log"
    )
    coarse = steps_of(log.rig, log.trials)
    quieter = dict.fromkeys(log.rig.sensors.by_column(), 1 / math.sqrt(count))
    return replace(
        log,
        rig=log.rig.model_copy(update={"sensors": log.rig.sensors.scaled(quieter)}),
        trials=tuple(_means(trial, count * step_s, count, coarse) for trial in log.trials),
        warnings=(*log.warnings, said),
        means_of=count,
        as_read=log.stated_rig,
    )


def _at_different_rates(log: RigLog) -> bool:
    """Whether trials have such different steps that no window suits all of them."""
    steps_s = [float(np.median(np.diff(trial["time_s"]))) for trial in log.trials]
    return max(steps_s) > ALIKE_RATES * min(steps_s)


def _means(trial: Trial, window_s: float, count: int, coarse: Collection[str]) -> Trial:
    """Means over windows that have at least half of their samples; medians of coarse columns."""
    time = trial["time_s"]
    window = np.floor((time - time[0]) / window_s + 0.5 / count).astype(int)
    columns = {str(name): _without_holes(time, trial[str(name)]) for name in trial.table}
    grouped = pd.DataFrame(columns).groupby(window)
    means = grouped.mean()
    for name in coarse:
        lower, higher = (grouped[name].quantile(interpolation=side) for side in ("lower", "higher"))
        means[name] = lower.where(means.index % 2 == 0, higher)  # of an even number of readings
    read = trial.table.notna().groupby(window).sum()
    enough = read >= AVERAGED_LEAST_SHARE * count
    table = means.where(enough)[enough["time_s"]]
    sensors = [sensor for sensor in SENSORS if sensor in table]
    ends = trial.table.iloc[[0, -1]].copy()
    ends[sensors] = np.nan
    table.loc[table.index == window[-1], sensors] = np.nan
    inside = (table["time_s"] > time[0]) & (table["time_s"] < time[-1])
    table = pd.concat([ends.iloc[:1], table[inside], ends.iloc[1:]], ignore_index=True)
    return replace(trial, table=table, rows=trial.file_rows)


def _without_holes(time_s: Array, values: Array) -> Array:
    """Readings interpolated across single missing ones, so that means belong to their windows."""
    read = np.isfinite(values)
    return values if read.all() or not read.any() else np.interp(time_s, time_s[read], values[read])
