"""An effect: a name of the vocabulary, its parameters, and the change that it makes to a rig."""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from enum import StrEnum

import numpy as np
from numpy.typing import NDArray

from diagnosis.replay.rig_parameters import RigParameters


class Place(StrEnum):
    """The part of the rig where an effect acts."""

    INTERFACE = "interface"
    TISSUE = "tissue"
    DRIVE = "drive"
    NEEDLE = "needle"
    SENSOR = "sensor"
    PARAMETERS = "parameters"


@dataclass(frozen=True, kw_only=True)
class Parameter:
    """A parameter of an effect.

    Attributes:
      name, unit: as in the vocabulary.
      low, high: bounds.
      start: starting values of fits; the first values of all parameters of an effect form one start,
        the second values another, and so on.
      logarithmic: fitted in its logarithm (positive parameters over decades).
      scale: unit in which a parameter that is not logarithmic is fitted.
      period: period of an angle; 0: none.
      reported: whether it is part of the vocabulary; else it is fitted and not reported.
      neutral: value at which the effect is absent; None: a parameter of shape, without such a value.
      prior_sigma: standard deviation of a normal prior on its coordinate about 0; infinite: none.
      least_factor: distance from neutral below which the effect is as good as none.
      of_one_trial: whether it changes one trial only, of which no other tells.
      fine: whether it is a coordinate of a curve that hardly changes it unless the curve is rough.
    """

    name: str
    unit: str
    low: float
    high: float
    start: tuple[float, ...]
    logarithmic: bool = False
    scale: float = 1.0
    period: float = 0.0
    reported: bool = True
    neutral: float | None = 0.0
    prior_sigma: float = math.inf
    least_factor: float = 0.0
    of_one_trial: bool = False
    fine: bool = False

    def scaled(self, *, torque: float, rate: float) -> "Parameter":
        """The same parameter for a rig with torques and rates that are larger by these factors."""
        factor = torque if "N mm" in self.unit else rate if self.unit == "rad/s" else 1.0
        if factor == 1.0:
            return self
        return replace(
            self,
            low=self.low * factor,
            high=self.high * factor,
            start=tuple(value * factor for value in self.start),
            scale=self.scale * factor,
        )

    def reaching(self, value: float) -> "Parameter":
        """The same parameter with an upper bound of at least this."""
        return self if value <= self.high else replace(self, high=value)

    def above(self, low: float) -> "Parameter":
        """The same parameter with a lower bound of at least this, and starts above half of it."""
        if low <= self.low:
            return self
        return replace(self, low=low, start=tuple(max(value, 0.5 * low) for value in self.start))

    def to_fit(self, value: float) -> float:
        """The coordinate of a value in a fit."""
        return float(np.log(value)) if self.logarithmic else value / self.scale

    def from_fit(self, x: float) -> float:
        """The value of a coordinate."""
        return float(np.exp(x)) if self.logarithmic else x * self.scale

    def slope(self, x: float) -> float:
        """Derivative of the value with respect to its coordinate."""
        return self.from_fit(x) if self.logarithmic else self.scale

    def turns(self, value: float) -> float:
        """Whole periods to subtract from an angle, so that it lies within half a period of 0."""
        return self.period * round(value / self.period) if self.period else 0.0

    def towards_neutral(self, value: float, share: float) -> float:
        """A value moved towards the neutral one, so that the effect has this share of its strength."""
        if self.neutral is None:
            return value
        if math.isinf(self.neutral):
            return value / share
        if self.is_a_factor:
            return float(value**share)
        return self.neutral + (value - self.neutral) * share

    def distance_from_neutral(self, value: float) -> float:
        """Strength of the effect at a value, which `towards_neutral` scales; NaN for a shape."""
        if self.neutral is None:
            return math.nan
        if math.isinf(self.neutral):
            return 1.0 / abs(value)
        return abs(math.log(value)) if self.is_a_factor else abs(value - self.neutral)

    @property
    def is_a_factor(self) -> bool:
        """Whether twice and half are as far from neutral."""
        return self.logarithmic and self.neutral == 1.0


def slopes_at(parameters: Sequence[Parameter], x: NDArray[np.float64]) -> NDArray[np.float64]:
    """Derivatives of values with respect to their coordinates x, (n,)."""
    return np.array([p.slope(float(own)) for p, own in zip(parameters, x, strict=True)])


@dataclass(frozen=True, kw_only=True)
class Effect:
    """An unmodelled effect.

    Attributes:
      title: in plain words.
      apply: adds the effect to a rig, given parameter values in order.
      contains: simpler effects that are special cases of this one; each with typical forms of this one,
        given the parameter values of the simpler one. Fits start from the first two.
      needs: column of a log without which the effect is not visible; empty: no further column.
      differences: steps of finite differences, in the units of the fit, for one fit after the
        other. A wide step averages over the roughness that stick and slip cause in a residual.
      trial: the only trial that it concerns; empty: all.
      differs: whether its strength may be another one in each trial.
      remedy: what to change in rig or model if it is found, as an instruction; values of parameters by
        name in braces, that of `corrects` as {constant}, and that of `same_as` as {same}.
      corrects: constant of rig.yaml whose true value is the nominal one times the first parameter.
      same_as: what of the rig would have to be off, and by how much, to do exactly the same, given the
        nominal rig and the parameter values: no effect of the library, and told beside it.
      check: how to measure it separately, as an instruction.
      other_forms: names of free-form laws of its kind, which leave less if its law has another form.
    """

    name: str
    title: str
    place: Place
    parameters: tuple[Parameter, ...]
    apply: Callable[..., RigParameters]
    contains: Mapping[str, Callable[..., tuple[tuple[float, ...], ...]]] = field(default_factory=dict)
    needs: str = ""
    differences: tuple[float, ...] = (1e-3,)
    trial: str = ""
    differs: bool = False
    remedy: str = ""
    corrects: str = ""
    same_as: Callable[..., str] | None = None
    check: str = ""
    other_forms: tuple[str, ...] = ()

    def weakened(self, part: NDArray[np.float64], share: float) -> NDArray[np.float64]:
        """Coordinates of its parameters in a fit, (n,), with this share of their strength."""
        each = zip(self.parameters, part, strict=True)
        return np.array([p.to_fit(p.towards_neutral(p.from_fit(float(x)), share)) for p, x in each])

    @property
    def delays_a_sensor(self) -> bool:
        """Whether it is a time by which a sensor is late."""
        return self.place is Place.SENSOR and any(p.unit == "s" for p in self.parameters)

    @property
    def reported(self) -> tuple[Parameter, ...]:
        """Parameters that are part of the vocabulary."""
        return tuple(p for p in self.parameters if p.reported)
