"""What is wrong with single readings of a log: a clock that ran, counts that were lost, a filter."""

from dataclasses import dataclass


@dataclass(frozen=True, kw_only=True)
class ClockStart:
    """How long the clock of a sensor ran before a trial.

    Attributes:
      trial: name of the trial.
      sensor: column of the reading.
    """

    trial: str
    sensor: str
    before_s: float


@dataclass(frozen=True, kw_only=True)
class ReadingJump:
    """A reading that is off from a moment on: an encoder that lost counts, a gauge that was knocked.

    For the needle, a base that reads more than it turned is a chuck that slipped.

    Attributes:
      trial: name of the trial.
      sensor: column of the reading.
      time_s: first sample that is off.
      size: by which it is off, in the unit of the column.
    """

    trial: str
    sensor: str
    time_s: float
    size: float

    @property
    def unit(self) -> str:
        """Of the size."""
        return "deg" if self.sensor.endswith("_deg") else "N mm"


@dataclass(frozen=True, kw_only=True)
class SmoothedReading:
    """A reading that was smoothed after recording, without delay (`diagnosis/prepare/low_band.py`).

    Attributes:
      sensor: column of the reading.
      second_coefficient, fourth_coefficient: of what the filter leaves at low frequencies.
    """

    sensor: str
    second_coefficient: float = 0.0
    fourth_coefficient: float = 0.0
