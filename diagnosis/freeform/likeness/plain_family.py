"""A family whose curve is the plain law that a free-form curve resembles.

Its parameters are those of the plain law y(x; p), and those of the free-form family that its curve does
not depend on. The rig gets the curve through the law's values, so its coordinates c solve

    min over c of  |curve(c) - y(p)|^2 / range^2 + W^2 |c - c_fit|^2

with a weight W so small that it decides only on what the curve does not depend on.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import least_squares

from diagnosis.effects.effect import Parameter
from diagnosis.freeform.family import FARTHEST, Family, Points, kind_of
from diagnosis.freeform.law_curve import Law
from diagnosis.freeform.likeness.likeness import Recognised
from diagnosis.replay.rig_parameters import RigParameters

Array = NDArray[np.float64]

_WEIGHT = 1e-4
_STEP = 1e-4  # of a parameter's size, to see what it changes
_CLOSE = 0.05  # of the range of the curve: as near as its coordinates have to come to a law


@dataclass(frozen=True, kw_only=True, eq=False)
class _Through:
    """Curves of a free-form family that run through the values of a plain law.

    Attributes:
      values: of the family's parameters, as they were fitted, (n,).
      shaping: indices of those that shape the curve.
      beside: indices of those that the curve does not depend on.
      x, y: the curve as it was fitted, (K,).
    """

    family: Family
    law: Callable[..., Array]
    count: int
    values: Array
    shaping: NDArray[np.intp]
    beside: NDArray[np.intp]
    x: Array
    y: Array

    @property
    def size(self) -> float:
        """Range of the curve."""
        return max(float(np.ptp(self.y)), np.finfo(float).tiny)

    def wanted(self, plain: Sequence[float] | Array) -> Array:
        """The law at the places of the curve, (K,)."""
        return np.asarray(self.law(self.x, *plain[: self.count]), float)

    def coordinates(self, plain: Sequence[float] | Array) -> Array:
        """Values of the family's parameters, (n,), with which its curve is the law."""
        wanted, values = self.wanted(plain), self.values.copy()
        values[self.beside] = plain[self.count :]
        begun = values[self.shaping]

        def off(shaping: Array) -> Array:
            values[self.shaping] = shaping
            return np.append((self.curve(values) - wanted) / self.size, _WEIGHT * (shaping - begun))

        values[self.shaping] = least_squares(off, begun, method="lm").x
        return values

    def curve(self, values: Array) -> Array:
        """The curve, (K,)."""
        return np.asarray(self.family.curve(*(float(v) for v in values))[1], float)


def plain_family(family: Family, values: Array, law: Law, found: Recognised) -> Family | None:
    """The family of the plain law; None: the curve of this family cannot have its shape, or the law does
    not depend on one of its numbers there, which no fit could find.

    Args:
      values: of the family's parameters, as they were fitted, (n,).
      law: the curve that they give.
      found: the shape that it resembles.
    """
    through = _through(family, values, law, found)
    if through is None:
        return None
    scales = _scales(through, found.values)
    if not np.isfinite(np.abs(found.values) + FARTHEST * scales).all():
        return None
    own = [_shape_parameter(i, *one) for i, one in enumerate(zip(found.values, scales, strict=True))]
    own += [_begun_at(family.effect.parameters[i], values[i]) for i in through.beside]
    effect = replace(
        family.effect,
        name=f"{family.effect.name}: {found.shape.name}",
        title=f"{family.effect.title}: {found.shape.name}",
        parameters=tuple(own),
        apply=partial(_apply, through),
    )
    return replace(
        family,
        effect=effect,
        curve=partial(_points, through),
        as_effect={},
        contains=(),
        shape=found.shape.name,
        factor=family.factor
        and replace(family.factor, effect=effect, curve=partial(_factor_points, through, family.factor)),
    )


def _through(family: Family, values: Array, law: Law, found: Recognised) -> _Through | None:
    shaping = np.flatnonzero([bool(kind_of(p)) for p in family.effect.parameters])
    if shaping.size == 0 or found.values.size >= shaping.size:
        return None
    through = _Through(
        family=family,
        law=found.shape.law,
        count=found.values.size,
        values=values,
        shaping=shaping,
        beside=np.array([i for i in range(values.size) if _is_beside(family, values, i)], np.intp),
        x=np.array(law.x),
        y=np.array(law.y),
    )
    plain = [*found.values, *values[through.beside]]
    off = through.curve(through.coordinates(plain)) - through.wanted(plain)
    return through if float(np.abs(off).max()) <= _CLOSE * through.size else None


def _is_beside(family: Family, values: Array, index: int) -> bool:
    """Whether the curve does not depend on a parameter."""
    moved = values.copy()
    moved[index] += _STEP * max(abs(moved[index]), family.effect.parameters[index].scale)
    here, there = (family.curve(*(float(v) for v in own))[1] for own in (values, moved))
    return bool(np.array_equal(np.asarray(here), np.asarray(there)))


def _scales(through: _Through, values: Array) -> Array:
    """By how much each parameter changes the law as much as its own range; infinite: by no change."""
    found = []
    for i, value in enumerate(values):
        step = _STEP * max(abs(float(value)), _STEP)
        moved = np.array(values)
        moved[i] += step
        slope: Array = (through.wanted(moved) - through.wanted(values)) / step
        size = float(np.sqrt(np.mean(slope**2)))
        found.append(through.size / size if size > 0.0 else np.inf)
    return np.array(found)


def _shape_parameter(number: int, value: float, scale: float) -> Parameter:
    return Parameter(
        name=f"shape {number}",
        unit="-",
        low=float(value) - FARTHEST * float(scale),
        high=float(value) + FARTHEST * float(scale),
        start=(float(value),),
        scale=float(scale),
    )


def _begun_at(parameter: Parameter, value: float) -> Parameter:
    return replace(parameter, start=(float(value),))


def _apply(through: _Through, rig: RigParameters, *plain: float) -> RigParameters:
    own = (float(v) for v in through.coordinates(plain))
    return through.family.effect.apply(rig, *own)


def _points(through: _Through, *plain: float) -> Points:
    return through.x, through.wanted(plain)


def _factor_points(through: _Through, factor: Family, *plain: float) -> Points:
    """The curve of the factor, which a plain law does not change."""
    return factor.curve(*(float(v) for v in through.coordinates(plain)))
