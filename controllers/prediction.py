"""The state of the needle when the next command arrives: a Smith predictor on its modes.

If sensors are late by d, and commands reach the servo after L, a controller decides at time t
from an estimate for t - d, and can change nothing before t + L. What happens in between
follows from the commands that were already sent:

    time                t - d               t           t + L
    known of the needle   estimate
    known of the shaft    encoder ------- servo model ------|     driven by commands in flight
    predicted                                             state

The angles of the shaft in that window are those of a model of the drive (models.servo), shifted by
the difference between encoder and model at t - d. They drive the modes of the base-driven needle;
the solution is exact, since the shaft's angle is linear between samples:

    c_k(t + L) = e^(p_k (d + L)) c_k(t - d) - a_k sum over pieces of rate_j (E_j - E_{j+1}) / p_k,
    E_j = e^(p_k (t + L - t_j))
"""

import math
from collections import deque
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from controllers.modal_lag import BaseModes
from models.needle import NonNegative
from models.record import Record
from models.servo import Servo

Array = NDArray[np.float64]

_RAD = math.pi / 180.0


class LoopTiming(Record):
    """Delays of sensors and drive of a rig, as its controller knows them."""

    measurement_delay_s: NonNegative = 0.0
    """Of base angle and torque."""
    command_latency_s: NonNegative = 0.0
    servo: Servo | None = None
    """None: the shaft is where it was commanded to be one sample later."""

    @property
    def lateness_s(self) -> float:
        """Delay from a command to the reading that shows its effect, s."""
        lag_s = self.servo.lag_s if self.servo else 0.0
        return self.measurement_delay_s + self.command_latency_s + lag_s


@dataclass(frozen=True, slots=True)
class PredictedState:
    """State when the next command arrives: shaft angle, deg, and rate, deg/s; modes of the lag, rad."""

    shaft_deg: float
    shaft_rate_deg_s: float
    lag_modes_rad: Array


class Predictor:
    """Predicts drive and modes from late measurements; see the module.

    At each sample call `advance`, then `predict`, then `send` with the new command.
    """

    def __init__(self, timing: LoopTiming) -> None:
        self.timing = timing
        self.reset()

    def reset(self) -> None:
        """Forget all commands."""
        self._command_deg = math.nan
        self._state = np.zeros(2)
        self._ahead: deque[tuple[float, float]] = deque()

    def advance(self, time_s: float, base_deg: float) -> None:
        """Advance the model of the drive to the time when the next command arrives.

        Args:
          time_s: of this sample.
          base_deg: angle of the shaft at the first sample.
        """
        arrival = time_s + self.timing.command_latency_s
        if not self._ahead:
            self._command_deg, self._state = base_deg, np.array([base_deg, 0.0])
            self._ahead.append((time_s - self.timing.measurement_delay_s, base_deg))
        passed = arrival - self._ahead[-1][0]
        if passed <= 0:
            return
        if self.timing.servo is None:
            self._state = np.array([self._command_deg, 0.0])
        else:
            self._state = self.timing.servo.after(self._state, self._command_deg, passed)
        self._ahead.append((arrival, float(self._state[0])))
        seen = time_s - self.timing.measurement_delay_s
        while len(self._ahead) > 2 and self._ahead[1][0] <= seen:
            self._ahead.popleft()

    def send(self, command_deg: float) -> None:
        """Note the command that is sent at this sample."""
        self._command_deg = command_deg

    def predict(self, modes: BaseModes, lag_modes_rad: Array, base_deg: float) -> PredictedState:
        """The state at the time when the next command arrives, from a late measurement.

        Args:
          modes: of the base-driven needle at its present lengths.
          lag_modes_rad: modes of the lag from the late measurement.
          base_deg: angle of the shaft in the same measurement.
        """
        arrival, angle = self._ahead[-1]
        seen = arrival - self.timing.command_latency_s - self.timing.measurement_delay_s
        if seen >= arrival:
            return PredictedState(base_deg, float(self._state[1]), lag_modes_rad)
        times, shaft = np.array(self._ahead).T
        at_seen = float(np.interp(seen, times, shaft))
        inside = times > seen
        times = np.concatenate([[seen], times[inside]])
        shaft = np.concatenate([[at_seen], shaft[inside]])
        decay = np.exp(np.outer(modes.poles, arrival - times))
        rates = (shaft[1:] - shaft[:-1]) / (times[1:] - times[:-1]) * _RAD
        driven = (decay[:, :-1] - decay[:, 1:]) @ rates
        lag = decay[:, 0] * lag_modes_rad - modes.participation / modes.poles * driven
        return PredictedState(angle + base_deg - at_seen, float(self._state[1]), lag)
