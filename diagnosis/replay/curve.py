"""A curve of one variable, as a part of a free-form law.

It is smooth through its values at some places of the variable, and constant beyond them. One with a
period is a periodic cubic spline: a sine through 5 places is off by less than 1 %.

A curve over the past gives the weights with which a reading shows past values instead of the present,
as a filter of first order with each time constant does,

    reading += sum over time constants of value (filtered value - present value),

or with which the angle of the drive follows the torque, as an insert that creeps does,

    angle += sum over time constants of value filtered torque.

A curve over the turn, or the advance, since the last reversal adds hysteresis (Prandtl-Ishlinskii),

    += sum over places r of value z_r,    z_r <- clamp(z_r + change, -r, r).

One over the lag of a reading gives the rate at which it follows: straight up to the last place, and
level. One over what a reading is held by gives, as its last value, how far the true value may be from it
before it jumps there.

What a curve adds may be multiplied by a course over another variable: play that grows in time.
"""

from dataclasses import dataclass, replace
from enum import StrEnum
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline, PchipInterpolator, PPoly

from diagnosis.replay.sensing.bearing import stopped_at
from diagnosis.replay.sensing.filters import first_order
from diagnosis.replay.sensing.held_reading import held_back
from diagnosis.replay.sensing.limited_rate import lag_at_limited_rate
from diagnosis.replay.sensing.variable_values import OF_INPUTS
from diagnosis.replay.variables import Variable
from models.errors import InvalidValue

Array = NDArray[np.float64]

_WEAKEST = 1e-6  # strength of a lag


class ActsOn(StrEnum):
    """What a curve changes."""

    TISSUE = "tissue"
    ORIENTATION = "orientation"
    STIFFNESS = "stiffness"
    TISSUE_ANGLE = "tissue_angle"
    TISSUE_SLIP = "tissue_slip"
    DRIVE_ANGLE = "drive_angle"
    DRIVE_SLIP = "drive_slip"
    INSERTED_LENGTH = "inserted_length"
    FREE_LENGTH = "free_length"
    TIP_TORQUE = "tip_torque"
    DRIVE_TORQUE = "drive_torque"
    TIP_READING = "tip_reading"
    TIP_COUNTS = "tip_counts"
    TORQUE_READING = "torque_reading"
    TIP_GAIN = "tip_gain"
    TORQUE_GAIN = "torque_gain"


FACTORS = (
    ActsOn.TISSUE,
    ActsOn.STIFFNESS,
    ActsOn.TIP_GAIN,
    ActsOn.TORQUE_GAIN,
)  # a curve multiplies them; to others it is added


@dataclass(frozen=True, kw_only=True)
class Course:
    """Values over a variable.

    Attributes:
      places: values of the variable, increasing.
      values: values of the curve at the places.
      period: period of the variable; 0: none.

    Raises:
      InvalidValue: places do not increase or span more than the period, or there are not as many values.
    """

    variable: Variable
    places: tuple[float, ...]
    values: tuple[float, ...]
    period: float = 0.0

    def __post_init__(self) -> None:
        places = np.asarray(self.places, float)
        if places.size < 2 or not (np.diff(places) > 0).all() or not np.isfinite(places).all():
            raise InvalidValue("places", self.places, "at least two finite numbers, increasing")
        if len(self.values) != places.size or not np.isfinite(self.values).all():
            raise InvalidValue(
                "values", self.values, f"{places.size} finite numbers, one for each place"
            )
        if self.period and self.period <= places[-1] - places[0]:
            raise InvalidValue("period", self.period, "0, or more than the places span")

    def at(self, x: Array) -> Array:
        """The curve at values of its variable, (N,)."""
        through = _through(self.places, self.values, self.period)
        if self.period:
            return np.asarray(through(self.places[0] + np.mod(x - self.places[0], self.period)))
        return np.asarray(through(np.clip(x, self.places[0], self.places[-1])))


@dataclass(frozen=True, kw_only=True)
class Curve(Course):
    """A curve of one variable that acts on something.

    Attributes:
      trial: the only trial that it applies to; empty: all.
      factor: what it adds is multiplied by, over another variable of the inputs; None: nothing.

    Raises:
      InvalidValue: as a course, or a factor is not positive, or would multiply a factor.
    """

    acts_on: ActsOn
    trial: str = ""
    factor: Course | None = None

    def __post_init__(self) -> None:
        super().__post_init__()
        multiplies = f"because the curve multiplies the {self.acts_on}"
        if self.acts_on in FACTORS and min(self.values) <= 0:
            raise InvalidValue("values", self.values, f"factors above 0, {multiplies}")
        if self.factor and self.acts_on in (*FACTORS, ActsOn.ORIENTATION):
            raise InvalidValue("factor", self.factor, f"none, {multiplies}")
        if self.factor and self.factor.variable not in OF_INPUTS:
            expected = f"a course over one of {', '.join(OF_INPUTS)}"
            raise InvalidValue("factor", self.factor.variable, expected)

    def with_hysteresis(self, values: Array) -> Array:
        """Hysteresis to add to an angle or a torque, (N,): stop operators (Prandtl-Ishlinskii)."""
        each = zip(self.places, self.values, strict=True)
        return np.asarray(np.sum([share * stopped_at(values, limit) for limit, share in each], axis=0))

    def behind(self, time_s: Array, values: Array) -> Array:
        """What a reading that follows at a limited rate is behind, (N,), to add to it."""
        lag, most_per_s = self.places[-1], self.values[-1]
        return np.asarray(-lag_at_limited_rate(time_s, values, lag / most_per_s, most_per_s))

    def held(self, values: Array) -> Array:
        """What is shown by a reading that stays until the value is too far from it, less that, (N,)."""
        return np.asarray(held_back(values, self.values[-1]))

    def times(self, strength: float) -> "Curve":
        """The curve multiplied by a strength; factors are raised to that power.

        One of the orientation stays: the law that it multiplies is multiplied. A reading follows faster.
        """
        if self.variable is Variable.LAG:
            return replace(self, values=tuple(value / max(strength, _WEAKEST) for value in self.values))
        if self.acts_on is ActsOn.ORIENTATION:
            return self
        if self.acts_on in FACTORS:
            return replace(self, values=tuple(value**strength for value in self.values))
        return replace(self, values=tuple(value * strength for value in self.values))

    def creep(self, time_s: Array, torque_n_mm: Array) -> Array:
        """Angle by which something yields to a torque in time, at even times, (N,)."""
        each = zip(self.places, self.values, strict=True)
        return np.asarray(np.sum([own * first_order(time_s, torque_n_mm, s) for s, own in each], axis=0))

    def of_past(self, time_s: Array, values: Array) -> Array:
        """Contribution of past values to a reading at even times, (N,)."""
        each = zip(self.places, self.values, strict=True)
        shown = [share * (first_order(time_s, values, time) - values) for time, share in each]
        return np.asarray(np.sum(shown, axis=0))


@lru_cache(maxsize=64)  # trial after trial asks for the same curves
def _through(places: tuple[float, ...], values: tuple[float, ...], period: float) -> PPoly:
    if not period:
        return PchipInterpolator(places, values)
    return CubicSpline((*places, places[0] + period), (*values, values[0]), bc_type="periodic")
