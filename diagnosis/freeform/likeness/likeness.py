"""The plain law that a free-form curve resembles.

Each shape is fitted to the points of the curve by least squares of differences / half width of the band.
The shape with the smallest

    chi-square + 2 (parameters)                                        (Akaike 1974)

is named if it lies within the band: a root mean square of at most one half width. If the library has
a law of that shape, at that place, of that variable and in that unit, it is named, too.
"""

import warnings
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import OptimizeWarning, curve_fit

from diagnosis.effects.effect import Place
from diagnosis.freeform.family import VISCOUS
from diagnosis.freeform.law_curve import Law
from diagnosis.freeform.likeness.shapes import LINE, OF_ANY, OF_BOTH_SIGNS, OF_RATE, Shape, of_angle
from diagnosis.freeform.missing.words import VARIABLES
from diagnosis.replay.variables import UNITS, Variable

Array = NDArray[np.float64]

_LEAST_BAND = 0.01  # of the range of a curve: no band is taken to be narrower
_WITHIN = 1.0  # half widths of the band, root mean square
_MOST_EVALUATIONS = 4000
_FEWEST = 3  # points of a curve
_NOTHING = 0.01  # of the range of a curve: a first term that is not told
_LEVEL = 1e-9  # range of a curve that is level, of its largest value
_ANGLES = ("base_angle", "tip_angle")
_DRY = "N mm / mm"  # per mm of shaft
LIBRARY_LAWS = {
    (Place.INTERFACE, "rate", _DRY, "dry and viscous friction"): ("coulomb_friction",),
    (Place.INTERFACE, "rate", _DRY, "power law"): ("shear_thinning",),
    (Place.INTERFACE, "rate", _DRY, "Stribeck friction"): ("stiction",),
    (Place.TISSUE, "position", VISCOUS, "step"): ("layered_tissue",),
    (Place.NEEDLE, "rate", "N mm", "dry and viscous friction"): ("tip_drag",),
    (Place.NEEDLE, "tip_angle", _DRY, "sine wave"): ("needle_curvature",),
    (Place.SENSOR, "tip_angle", "deg", "straight line"): ("tip_angle_scale", "tip_angle_bias"),
    (Place.SENSOR, "torque", "N mm", "straight line"): ("torque_scale", "torque_bias"),
}
"""Effects of the library by place, variable, unit of the law and shape."""


@dataclass(frozen=True, kw_only=True)
class Likeness:
    """A plain law that a curve resembles.

    Attributes:
      says: the law in words, with its values.
      library: effects of the library with a law of that shape; may be empty.
    """

    shape: str
    says: str
    library: tuple[str, ...]


@dataclass(frozen=True, kw_only=True, eq=False)
class Recognised:
    """A shape with the parameters for which it lies within the band of a curve, (n,)."""

    shape: Shape
    values: Array


def likeness_of(law: Law) -> Likeness | None:
    """The plain law that a curve resembles, in words; None: none of the known ones."""
    found = recognised(law)
    if not found:
        return None
    shape, values = found[0].shape, found[0].values
    library = LIBRARY_LAWS.get((law.place, law.variable, law.unit, shape.name), ())
    x, y = ("" if unit == "-" else f" {unit}" for unit in (law.x_unit, law.unit))
    of = f"{VARIABLES[law.variable]}{x and f' in{x}'}"
    told = [0.0 if own == values[0] and abs(own) < _NOTHING * np.ptp(law.y) else own for own in values]
    share = x.startswith(" of ")  # of the structure that is broken, say: between 0 and 1 of it
    per = f"1{x}" if share else x.strip() or "unit"
    says = shape.says.format(*told, x=x, y=y, per=per, variable=of)
    says = says.removeprefix(f"0{y} + ")
    return Likeness(shape=shape.name, says=says, library=library)


def recognised(law: Law) -> list[Recognised]:
    """Shapes within the band of a curve, likeliest first; none if the law is level, or no curve."""
    if not _bends(law):
        return []
    x, y, half = _points_of(law)
    tried = []
    for shape in _shapes_of(law):
        fitted = _fitted(shape, x, y, half)
        if fitted is not None:
            values, chi_square = fitted
            tried.append((chi_square, Recognised(shape=shape, values=values)))
    tried.sort(key=lambda one: one[0] + 2 * one[1].values.size)
    if not tried or tried[0][0] > _WITHIN**2 * x.size:
        return []
    return [found for chi_square, found in tried if chi_square <= _WITHIN**2 * x.size]


def plain_laws_of(law: Law, most: int) -> list[Recognised]:
    """Shapes that may be the law of a curve: the likeliest of those within its band, and the straight
    line nearest to it in its band, wherever that is.

    What a variable of the past is made of is fitted, too: beside other numbers of it the law may be
    straight where the curve is not.
    """
    first = recognised(law)[:most]
    line = next((shape for shape in _shapes_of(law) if shape.name == LINE), None)
    if line is None or not _bends(law) or any(one.shape is line for one in first):
        return first
    nearest = _fitted(line, *_points_of(law))
    return [*first, Recognised(shape=line, values=nearest[0])] if nearest else first


def _points_of(law: Law) -> tuple[Array, Array, Array]:
    """Places, values and half the width of the band of a curve, (K,) each."""
    y, half = np.array(law.y), 0.5 * (np.array(law.high) - np.array(law.low))
    return np.array(law.x), y, np.maximum(half, _LEAST_BAND * max(float(np.ptp(y)), 1e-12))


def _bends(law: Law) -> bool:
    """Whether it is a curve, and not level."""
    if law.variable in ("direction", "event") or len(law.x) < _FEWEST:
        return False
    return float(np.ptp(law.y)) > _LEVEL * float(np.abs(law.y).max())


def _shapes_of(law: Law) -> tuple[Shape, ...]:
    every = _of_variable(law)
    return tuple(shape for shape in every if shape.name == law.shape) if law.shape else every


def _of_variable(law: Law) -> tuple[Shape, ...]:
    x = np.array(law.x)
    either = OF_BOTH_SIGNS if x.min() < 0 < x.max() else ()
    if law.variable == "rate" and law.x_unit == UNITS[Variable.RATE]:  # not that of an acceleration
        return (*OF_RATE, *OF_ANY[:1])
    return (*OF_ANY, *either, *(of_angle(x) if law.variable in _ANGLES else ()))


def _fitted(shape: Shape, x: Array, y: Array, half: Array) -> tuple[Array, float] | None:
    """Parameters and chi-square of a shape with fewer parameters than points."""
    start = shape.start(x, y)
    if len(start) >= x.size:
        return None
    try:
        with warnings.catch_warnings(), np.errstate(all="ignore"):
            warnings.simplefilter("ignore", OptimizeWarning)
            bounds = (shape.low or -np.inf, np.inf)
            values, _ = curve_fit(shape.law, x, y, start, half, bounds=bounds, maxfev=_MOST_EVALUATIONS)
    except RuntimeError:
        return None
    left = (y - shape.law(x, *values)) / half
    chi_square = float(left @ left)
    return (values, chi_square) if np.isfinite(chi_square) else None
