"""Lines over time in a rerun recording: the timeline, and one signal.

Output only: nothing that computes imports this module. Times are whole nanoseconds; columns are
sent at once, so a run of a minute takes milliseconds.
"""

from typing import Any

import numpy as np
import rerun as rr
from numpy.typing import NDArray

Array = NDArray[np.float64]

TIMELINE = "time"


def time_column(time_s: Array) -> Any:
    """The timeline in whole nanoseconds, from times in s, (N,)."""
    nanoseconds = np.round(time_s * 1e9).astype("timedelta64[ns]")
    return rr.TimeColumn(TIMELINE, duration=nanoseconds)


def log_series(
    stream: rr.RecordingStream,
    path: str,
    label: str,
    time_s: Array,
    values: Array,
    colour: list[int],
) -> None:
    """Log one line of a plot: times, s, and values, (N,) each."""
    stream.log(path, rr.SeriesLines(colors=[colour], names=[label]), static=True)
    stream.send_columns(path, indexes=[time_column(time_s)], columns=rr.Scalars.columns(scalars=values))
