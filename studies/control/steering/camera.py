"""A camera that observes the tip: exposures at a fixed rate, white noise, images that arrive late.

The paper's stereo cameras gave triangulated points at 7.5 Hz (Section V); ultrasound
resolves 0.8 mm (Section I).
"""

from dataclasses import dataclass
from typing import Annotated

import numpy as np
from numpy.typing import ArrayLike, NDArray
from pydantic import Field

from models.errors import InvalidValue
from models.needle import Positive
from models.record import Record

Array = NDArray[np.float64]

_SAME_TIME_S = 1e-9


class CameraModel(Record):
    """Rate, noise and delay.

    Raises:
      InvalidValue: an image would arrive after the next exposure.
    """

    rate_hz: Positive = 7.5
    noise_mm: Annotated[float, Field(ge=0)] = 0.5
    """One standard deviation of each coordinate."""
    delay_s: Annotated[float, Field(ge=0)] = 0.1
    """From exposure to the position that is read off the image."""

    def model_post_init(self, context: object, /) -> None:
        """Check that an image arrives before the next exposure."""
        if self.delay_s * self.rate_hz >= 1:
            raise InvalidValue(
                "delay_s", self.delay_s, f"less than {1 / self.rate_hz:g} s, the time between images"
            )


CAMERA = CameraModel()


@dataclass(frozen=True, slots=True)
class View:
    """What a camera does at one sample.

    Attributes:
      exposes: an image is taken now.
      position_mm: position in the image of the last exposure, if that arrives now; else None.
    """

    exposes: bool
    position_mm: Array | None


class Camera:
    """A camera during a run.

    Args:
      seed: seed of the noise.
    """

    def __init__(self, model: CameraModel, *, seed: int) -> None:
        self.model, self._noise = model, np.random.default_rng(seed)
        self._exposures = 0
        self._pending: tuple[float, Array] | None = None

    def look(self, time_s: float, position_mm: ArrayLike) -> View:
        """Take an image if one is due, and return the one that arrives.

        Args:
          time_s: increasing from call to call.
          position_mm: present position of the tip, (n,).
        """
        arrived = self._arrived(time_s)
        exposes = time_s > self._exposures / self.model.rate_hz - _SAME_TIME_S
        if exposes:
            self._exposures += 1
            place = np.asarray(position_mm, float)
            seen = place + self._noise.normal(0.0, self.model.noise_mm, place.shape)
            self._pending = (time_s + self.model.delay_s, seen)
        return View(exposes, arrived)

    def _arrived(self, time_s: float) -> Array | None:
        if self._pending is None or time_s < self._pending[0] - _SAME_TIME_S:
            return None
        position = self._pending[1]
        self._pending = None
        return position
