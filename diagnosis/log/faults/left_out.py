"""Readings that are left out of a log because an explanation shows that they are outliers."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from diagnosis.log.rig_log import RigLog
from diagnosis.log.trial import Trial

Array = NDArray[np.float64]

_NAMED = 5  # times in a warning


@dataclass(frozen=True, kw_only=True, eq=False)
class LeftOut:
    """Readings of one sensor in one trial that are left out.

    Attributes:
      trial: name of its file.
      times_s: times of these readings, (N,).
      samples: number of readings that the sensor has in the trial.
    """

    trial: str
    sensor: str
    times_s: Array
    samples: int

    @property
    def warning(self) -> str:
        """What was left out, and why, in words."""
        count = self.times_s.size
        at = ", ".join(f"{time_s:g}" for time_s in self.times_s[:_NAMED])
        more = f" and {count - _NAMED} more" if count > _NAMED else ""
        return (
            f"{self.trial}: {self.sensor} is far off the explanation in {count} of {self.samples} "
            f"samples, at {at}{more} s, and beside them it is not (outliers); these samples are not used"
        )

    def without(self, time_s: Array, readings: Array) -> Array:
        """Readings of the sensor in the trial, NaN where they are left out, (N,)."""
        return np.where(np.isin(time_s, self.times_s), np.nan, readings)


def without(log: RigLog, left_out: Sequence[LeftOut]) -> RigLog:
    """The log without these readings, and with a warning about them."""
    trials = tuple(
        _without(trial, [own for own in left_out if own.trial == trial.name]) for trial in log.trials
    )
    return replace(log, trials=trials, warnings=(*log.warnings, *(own.warning for own in left_out)))


def _without(trial: Trial, left_out: Sequence[LeftOut]) -> Trial:
    columns = {own.sensor: own.without(trial["time_s"], trial[own.sensor]) for own in left_out}
    return replace(trial, table=trial.table.assign(**columns)) if columns else trial
