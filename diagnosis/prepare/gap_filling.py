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

from diagnosis.criteria import (
    GAP_CERTAIN_DEG,
    GAP_FORGOTTEN_S,
    GAP_SIDE_SAMPLES,
    GAP_STEPS,
)
from diagnosis.log.trial import SENSORS, Trial

Array = NDArray[np.float64]


def fill_gaps(trial: Trial) -> Trial:
    """The trial with rows in its gaps: what its encoder would have read, and nothing of the sensors."""
    time = trial["time_s"]
    steps = np.diff(time)
    usual = float(np.median(steps))
    filled = [_fill(trial, int(i), usual) for i in np.flatnonzero(steps > GAP_STEPS * usual)]
    if not filled:
        return trial
    table = pd.concat([trial.table, *filled]).sort_values("time_s", ignore_index=True)
    for rows in filled:
        if _doubtful(trial, rows):
            last = float(rows["time_s"].iloc[-1])
            after = (table["time_s"] > last) & (table["time_s"] <= last + GAP_FORGOTTEN_S)
            table.loc[after, [s for s in SENSORS if s in table]] = np.nan
    return replace(trial, table=table)


def _doubtful(trial: Trial, rows: pd.DataFrame) -> bool:
    straight = np.interp(rows["time_s"], trial["time_s"], trial["base_angle_deg"])
    return bool(np.abs(rows["base_angle_deg"] - straight).max() > GAP_CERTAIN_DEG)


def _fill(trial: Trial, before: int, usual: float) -> pd.DataFrame:
    """Rows between the samples `before` and the next."""
    time = trial["time_s"]
    start, end = time[before], time[before + 1]
    inside = np.linspace(start, end, round((end - start) / usual) + 1)[1:-1]
    near = slice(max(before + 1 - GAP_SIDE_SAMPLES, 0), before + 1 + GAP_SIDE_SAMPLES)
    middle, scale = 0.5 * (start + end), end - start
    cubic = np.polynomial.Polynomial.fit((time[near] - middle) / scale, trial["base_angle_deg"][near], 3)
    rows = {"time_s": inside, "base_angle_deg": cubic((inside - middle) / scale)}
    for name in ("inserted_mm", "free_mm", "speed_mm_s"):
        rows[name] = np.interp(inside, time, trial[name])
    if trial.has("tip_torque_n_mm"):
        rows["tip_torque_n_mm"] = np.interp(inside, time, np.nan_to_num(trial["tip_torque_n_mm"]))
    return pd.DataFrame(rows)
