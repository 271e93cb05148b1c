"""The readings that a controller receives, with noise, bias, quantisation and delay.

reading(t) = step round((value(t - delay) + bias + noise) / step)
"""

from dataclasses import dataclass

import numpy as np

from models.errors import InvalidValue
from sim.loop.delay_line import DelayLine
from sim.loop.hardware import Sensors

CHANNELS = ("base_deg", "torque_n_mm", "tip_deg")


@dataclass(frozen=True, kw_only=True)
class Measurement:
    """Readings of all sensors at one sample: s, deg, N mm, mm."""

    time_s: float
    base_deg: float
    torque_n_mm: float
    tip_deg: float
    inserted_mm: float
    free_mm: float


@dataclass(frozen=True, kw_only=True)
class MeasurementNoise:
    """Standard deviation of each sensor's white noise, and the seed of a run."""

    base_deg: float = 0.0
    torque_n_mm: float = 0.0
    tip_deg: float = 0.0
    seed: int = 0


def quantised(value: float, step: float) -> float:
    """The nearest multiple of a step; a step of 0 changes nothing."""
    return step * round(value / step) if step else value


class SensorReadings:
    """The sensors of one run: call `read` once a sample.

    Args:
      samples: number of samples of the run; the noise of all is drawn at once, from the seed.
      step_s: sampling interval.
    """

    def __init__(
        self, sensors: Sensors, noise: MeasurementNoise, *, samples: int, step_s: float
    ) -> None:
        spread = np.array([noise.base_deg, noise.torque_n_mm, noise.tip_deg])
        if not np.all(spread >= 0):
            raise InvalidValue("noise", spread.tolist(), "standard deviations of at least 0")
        self._noise = np.random.default_rng(noise.seed).normal(size=(samples, 3)) * spread
        self._steps = (sensors.base_step_deg, sensors.torque_step_n_mm, sensors.tip_step_deg)
        self._bias = (0.0, sensors.torque_bias_n_mm, 0.0)
        delays = (sensors.base_delay_s, sensors.torque_delay_s, sensors.tip_delay_s)
        self._lines = [DelayLine(delay, step_s) for delay in delays]

    def read(self, sample: int, values: tuple[float, float, float]) -> tuple[float, float, float]:
        """Readings of base, torque and tip; true `values` in the order of `CHANNELS`."""
        base, torque, tip = (
            line(quantised(value + bias + noise, step))
            for line, value, bias, noise, step in zip(
                self._lines, values, self._bias, self._noise[sample], self._steps, strict=True
            )
        )
        return base, torque, tip
