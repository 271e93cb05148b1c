"""The motion of the base across gaps in a log.

Where samples are missing the base went on moving, and the needle remembers. A cubic
through the readings on both sides follows a smooth motion across the gap; rows
without readings of the sensors hold it. Where the base turned so fast that a cubic and
a straight line disagree, neither is certain: what the sensors read in the second after
such a gap is not used.
"""

from dataclasses import replace

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from diagnosis.rig_log import SENSORS, RigLog, Trial

Array = NDArray[np.float64]

_GAP = 2.5  # steps of the median length that are a gap
_CERTAIN_DEG = 0.2
_FORGOTTEN_S = 1.0  # after which a needle has mostly forgotten how the base got where it is
_SIDE = 12  # readings on each side that the cubic goes through


def bridged(log: RigLog) -> RigLog:
    """The same log with rows in its gaps."""
    return replace(log, trials=tuple(_bridge(trial) for trial in log.trials))


def original(trial: Trial, bridge: Trial) -> NDArray[np.bool_]:
    """Which rows of a bridged trial are of the trial itself."""
    return np.isin(bridge["time_s"], trial["time_s"])


def _bridge(trial: Trial) -> Trial:
    time = trial["time_s"]
    steps = np.diff(time)
    usual = float(np.median(steps))
    filled = [_fill(trial, int(i), usual) for i in np.flatnonzero(steps > _GAP * usual)]
    if not filled:
        return trial
    table = pd.concat([trial.table, *filled]).sort_values("time_s", ignore_index=True)
    for rows in filled:
        if _doubtful(trial, rows):
            last = float(rows["time_s"].iloc[-1])
            after = (table["time_s"] > last) & (table["time_s"] <= last + _FORGOTTEN_S)
            table.loc[after, [s for s in SENSORS if s in table]] = np.nan
    return replace(trial, table=table)


def _doubtful(trial: Trial, rows: pd.DataFrame) -> bool:
    straight = np.interp(rows["time_s"], trial["time_s"], trial["base_angle_deg"])
    return bool(np.abs(rows["base_angle_deg"] - straight).max() > _CERTAIN_DEG)


def _fill(trial: Trial, before: int, usual: float) -> pd.DataFrame:
    """Rows between the samples `before` and the next."""
    time = trial["time_s"]
    start, end = time[before], time[before + 1]
    inside = np.linspace(start, end, round((end - start) / usual) + 1)[1:-1]
    near = slice(max(before + 1 - _SIDE, 0), before + 1 + _SIDE)
    middle, scale = 0.5 * (start + end), end - start
    cubic = np.polynomial.Polynomial.fit((time[near] - middle) / scale, trial["base_angle_deg"][near], 3)
    rows = {"time_s": inside, "base_angle_deg": cubic((inside - middle) / scale)}
    for name in ("inserted_mm", "free_mm", "speed_mm_s"):
        rows[name] = np.interp(inside, time, trial[name])
    if trial.has("tip_torque_n_mm"):
        rows["tip_torque_n_mm"] = np.interp(inside, time, np.nan_to_num(trial["tip_torque_n_mm"]))
    return pd.DataFrame(rows)
