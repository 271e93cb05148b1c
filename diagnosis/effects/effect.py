"""What an effect is: a name of the vocabulary, its parameters, and what it changes of a rig."""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from enum import StrEnum

import numpy as np

from diagnosis.replay.rig_parameters import RigParameters


class Place(StrEnum):
    """Where in the machine an effect lives."""

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
      start: where fits may start: the values of one start stand in the same place of
        every parameter of an effect.
      logarithmic: fitted in its logarithm (positive parameters over decades).
      scale: what a parameter that is not logarithmic is fitted in units of.
      period: of an angle, after which it repeats; 0: none.
      reported: whether it is of the vocabulary; else it is open in a fit and not told.
      neutral: value at which the effect is not there; None: a shape, at which it always is.
      prior_sigma: of a normal prior on its coordinate about 0; infinite: none.
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

    def scaled(self, *, torque: float, rate: float) -> "Parameter":
        """The same for a rig whose torques and rates are so many times larger."""
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
        """The same with a highest value of at least this."""
        return self if value <= self.high else replace(self, high=value)

    def above(self, low: float) -> "Parameter":
        """The same with a lowest value of at least this, and starts half way down to it at most."""
        if low <= self.low:
            return self
        return replace(self, low=low, start=tuple(max(value, 0.5 * low) for value in self.start))

    def to_fit(self, value: float) -> float:
        """The coordinate of a value that a fit moves in."""
        return float(np.log(value)) if self.logarithmic else value / self.scale

    def from_fit(self, x: float) -> float:
        """The value of a coordinate."""
        return float(np.exp(x)) if self.logarithmic else x * self.scale

    def slope(self, x: float) -> float:
        """Change of the value with its coordinate."""
        return self.from_fit(x) if self.logarithmic else self.scale

    def turns(self, value: float) -> float:
        """Whole periods of an angle, to take off so that it lies in the half periods about 0."""
        return self.period * round(value / self.period) if self.period else 0.0

    def towards_neutral(self, value: float, share: float) -> float:
        """A value moved so far that the effect is a share of what it was."""
        match self.neutral:
            case None:
                return value
            case math.inf:
                return value / share
            case 1.0:
                return float(value**share)
        return value * share

    def distance_from_neutral(self, value: float) -> float:
        """How strong the effect is at a value; `towards_neutral` multiplies it. NaN: a shape."""
        match self.neutral:
            case None:
                return math.nan
            case math.inf:
                return 1.0 / abs(value)
            case 1.0:
                return abs(math.log(value))
        return abs(value)


@dataclass(frozen=True, kw_only=True)
class Effect:
    """An unmodelled effect.

    Attributes:
      title: in plain words.
      apply: the rig with this effect in it, given parameter values in order.
      contains: simpler effects that this one becomes for some parameters; each with where a fit of
        this one may start, given the parameter values of the simpler one.
      needs: column of a log without which it cannot show; empty: none beyond the usual.
      differences: that slopes are taken over, in the units of the fit, one fit after the
        other. Where stick and slip make a residual rough, a wide one sees past that.
      trial: the one trial that it is about; empty: all.
      remedy: what to change of rig or model where it is found, as an order; values of parameters by
        name in braces, that of `corrects` as {constant}.
      corrects: constant of rig.yaml whose true value is the nominal one times the first parameter.
      check: how to measure it by itself, as an order.
      other_forms: names of free-form laws of its kind, which leave less where the law has another form.
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
    remedy: str = ""
    corrects: str = ""
    check: str = ""
    other_forms: tuple[str, ...] = ()

    @property
    def reported(self) -> tuple[Parameter, ...]:
        """Parameters of the vocabulary."""
        return tuple(p for p in self.parameters if p.reported)
