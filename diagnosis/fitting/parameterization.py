"""The parameters of a set of effects as the vector of a fit.

Positive parameters that span decades are fitted in their logarithm, others in their own
unit, so that a step of 0.001 is small for each, but not lost in rounding.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from diagnosis.effects import FITTED
from diagnosis.effects.effect import Effect, Parameter
from diagnosis.fitting.nuisance import prior_sigma
from diagnosis.replay.rig_parameters import NOMINAL, RigParameters
from models.errors import InvalidValue
from sim.needles.run import SimulationFailed

Array = NDArray[np.float64]

_ROUNDING = 1e-9  # of a vector, whose entries are of the order of one


@dataclass(frozen=True, kw_only=True)
class Parameterization:
    """The meaning of the entries of a fit's vector: parameters of effects, then nuisance parameters.

    Attributes:
      effects: effects that are fitted.
      nuisance: effects that every fit includes.
      base: the rig that they change.
    """

    effects: tuple[Effect, ...]
    nuisance: tuple[Effect, ...]
    base: RigParameters = NOMINAL

    @cached_property
    def all(self) -> tuple[Effect, ...]:
        """Effects and nuisance, in the order of the vector."""
        return (*self.effects, *self.nuisance)

    @cached_property
    def parameters(self) -> tuple[Parameter, ...]:
        """Parameters of all effects, then of the nuisance."""
        return tuple(p for e in self.all for p in e.parameters)

    def bounds(self) -> tuple[Array, Array]:
        """Lowest and highest vector."""
        low, high = self._bounds
        return low.copy(), high.copy()

    @cached_property
    def _bounds(self) -> tuple[Array, Array]:
        low = [p.to_fit(p.low) for p in self.parameters]
        high = [p.to_fit(p.high) for p in self.parameters]
        return np.array(low), np.array(high)

    def held(self, x: Array) -> NDArray[np.bool_]:
        """Mask of the entries of a vector that are at a bound."""
        low, high = self._bounds
        return np.asarray((x <= low) | (x >= high))

    def parts(self, x: Array) -> dict[str, Array]:
        """The part of a vector that belongs to each effect, by name."""
        ends = np.cumsum([len(e.parameters) for e in self.all])
        return (
            dict(zip([e.name for e in self.all], np.split(x, ends[:-1]), strict=True))
            if ends.size
            else {}
        )

    def joined(self, parts: Mapping[str, Array]) -> Array:
        """The vector with these parts; all others are neutral."""
        own = [parts.get(e.name, np.zeros(len(e.parameters))) for e in self.all]
        return np.concatenate(own) if own else np.zeros(0)

    def values(self, x: Array) -> list[float]:
        """Parameter values of a vector, clipped to the bounds against rounding."""
        within = np.clip(x, *self._bounds)
        near = np.where(np.abs(within - x) < _ROUNDING, within, x)
        return [p.from_fit(float(v)) for p, v in zip(self.parameters, near, strict=True)]

    def rig(self, x: Array) -> RigParameters:
        """The rig with these effects in it.

        Raises:
          SimulationFailed: there is no rig with these values.
        """
        rig, values = self.base, self.values(x)
        try:
            for effect in self.all:
                count = len(effect.parameters)
                rig = effect.apply(rig, *values[:count])
                values = values[count:]
        except InvalidValue as refused:
            raise SimulationFailed(f"there is no rig with these parameters: {refused}") from refused
        return rig

    @property
    def free(self) -> int:
        """Number of entries of the effects; those of the nuisance follow."""
        return sum(len(e.parameters) for e in self.effects)

    @property
    def owners(self) -> tuple[str, ...]:
        """The effect that every entry of the vector belongs to."""
        return tuple(e.name for e in self.all for _ in e.parameters)

    @cached_property
    def weights(self) -> Array:
        """Weights of the prior on every entry, 1 / standard deviation; 0 without a prior."""
        spread = [p.prior_sigma for e in self.effects for p in e.parameters]
        spread += [prior_sigma(effect) for effect in self.nuisance for _ in effect.parameters]
        return np.array([1.0 / own for own in spread])

    @property
    def about_one_trial(self) -> NDArray[np.bool_]:
        """Mask of the entries that concern one trial only."""
        each = [bool(e.trial) or p.of_one_trial for e in self.all for p in e.parameters]
        return np.array(each, bool)


def parameterization_of(
    names: Sequence[str],
    nuisance: Sequence[Effect] = (),
    library: Mapping[str, Effect] = FITTED,
    base: RigParameters = NOMINAL,
) -> Parameterization:
    """The parameterization of effects by name; a nuisance effect among them counts as an effect."""
    others = tuple(e for e in nuisance if e.name not in names)
    return Parameterization(effects=tuple(library[n] for n in names), nuisance=others, base=base)


def starts(effect: Effect) -> list[Array]:
    """Starts of a fit of an effect: vectors of its own parameters."""
    each = zip(*(p.start for p in effect.parameters), strict=True)
    return [
        np.array([p.to_fit(v) for p, v in zip(effect.parameters, values, strict=True)])
        for values in each
    ]
