"""Logs of more than 200 samples a second, averaged to about 100: as much is known, ten times sooner.

What a needle does takes a hundredth of a second and longer, and a replay takes a step for every sample.
Means over windows of a hundredth of a second keep what readings tell: of n samples with white noise,
the mean has sigma / sqrt(n). A window answers to the mean of its inputs as a sample does to a sample, so
base angle, lengths and torques are averaged alike. The first and the last sample stay as they are,
for the motion of the base to begin and end where it did; the sensors are left out there.
"""

import math
from dataclasses import replace

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from diagnosis.criteria import AVERAGED_ABOVE_HZ, AVERAGED_LEAST_SHARE, AVERAGING_S
from diagnosis.log.nominal_rig import NominalRig
from diagnosis.log.rig_log import RigLog
from diagnosis.log.trial import SENSORS, Trial

Array = NDArray[np.float64]


def averaged(log: RigLog) -> RigLog:
    """The log with the means of its windows for samples, if it has more than are of use."""
    step_s = float(np.median(np.concatenate([np.diff(trial["time_s"]) for trial in log.trials])))
    count = int(AVERAGING_S / step_s + 1e-6)
    if step_s * AVERAGED_ABOVE_HZ >= 1 or count < 2:
        return log
    said = (
        f"{1 / step_s:.0f} samples a second: means of {count} samples are diagnosed; predictions in the "
        "report are at the samples of the log"
    )
    return replace(
        log,
        rig=_quieter(log.rig, count),
        trials=tuple(_means(trial, count * step_s, count) for trial in log.trials),
        warnings=(*log.warnings, said),
    )


def _quieter(rig: NominalRig, count: int) -> NominalRig:
    """The rig with the noise that means of so many samples have."""
    claims = rig.sensors.model_dump()
    sensors = rig.sensors.model_copy(update={k: v / math.sqrt(count) for k, v in claims.items()})
    return rig.model_copy(update={"sensors": sensors})


def _means(trial: Trial, window_s: float, count: int) -> Trial:
    """Means over windows that hold half of their samples at least."""
    time = trial["time_s"]
    window = np.floor((time - time[0]) / window_s + 0.5 / count).astype(int)
    columns = {str(name): _without_holes(time, trial[str(name)]) for name in trial.table}
    grouped = pd.DataFrame(columns).groupby(window)
    means = grouped.mean()
    read = trial.table.notna().groupby(window).sum()
    enough = read >= AVERAGED_LEAST_SHARE * count
    table = means.where(enough)[enough["time_s"]]
    ends = trial.table.iloc[[0, -1]].copy()
    ends[[sensor for sensor in SENSORS if sensor in ends]] = np.nan
    inside = (table["time_s"] > time[0]) & (table["time_s"] < time[-1])
    table = pd.concat([ends.iloc[:1], table[inside], ends.iloc[1:]], ignore_index=True)
    return replace(trial, table=table, rows=trial.file_rows)


def _without_holes(time_s: Array, values: Array) -> Array:
    """Readings across single holes, so that a mean with some is not that of other times."""
    read = np.isfinite(values)
    return values if read.all() or not read.any() else np.interp(time_s, time_s[read], values[read])
