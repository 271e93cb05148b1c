"""From a curve to a name: which plain law a free-form one looks like.

Each shape is fitted to the curve's points by least squares over the half width of its band, and that of
least

    chi-square + 2 (parameters)                                        (Akaike 1974)

is named if it runs within the band: a root mean square of at most one half width. Where the library has
a law of that shape, at that place and of that variable, it is named too.
"""

import warnings
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import OptimizeWarning, curve_fit

from diagnosis.effects.effect import Place
from diagnosis.freeform.missing import Law

Array = NDArray[np.float64]

_LEAST_BAND = 0.01  # of the range of a curve: no band is taken to be narrower
_WITHIN = 1.0  # half widths of the band, root mean square
_MOST_EVALUATIONS = 4000
_STEP_WIDTH = (
    0.03  # of the range: less than from one point to the next, not so steep that no fit finds it
)
_MOST_CYCLES = 4  # of a wave in one turn, from which a fit starts


@dataclass(frozen=True, kw_only=True)
class Shape:
    """A plain law.

    Attributes:
      says: in words, with values of the parameters in braces by their place.
      law: of x and the parameters.
      start: of the parameters, from x and y.
    """

    name: str
    says: str
    law: Callable[..., Array]
    start: Callable[[Array, Array], tuple[float, ...]]


@dataclass(frozen=True, kw_only=True)
class Likeness:
    """A plain law that a curve looks like.

    Attributes:
      says: in words, with its values.
      library: effects of the library with a law of that shape; may be none.
    """

    shape: str
    says: str
    library: tuple[str, ...]


def _constant(x: Array, a: float) -> Array:
    return np.full(x.shape, a)


def _line(x: Array, a: float, b: float) -> Array:
    return a + b * x


def _decay(x: Array, a: float, b: float, tau: float) -> Array:
    return np.asarray(a + b * np.exp(-(x - x[0]) / abs(tau)))


def _step(x: Array, a: float, b: float, at: float) -> Array:
    width = _STEP_WIDTH * (x[-1] - x[0])
    return np.asarray(a + 0.5 * b * (1.0 + np.tanh((x - at) / width)))


def _wave(x: Array, a: float, b: float, phase: float, cycles: float) -> Array:
    return np.asarray(a + b * np.sin(np.radians(cycles * x) + phase))


def _power(x: Array, a: float, p: float) -> Array:
    return np.asarray(a * np.abs(x) ** p)


def _dry_and_viscous(x: Array, level: float, damping: float) -> Array:
    return np.asarray(np.sign(x) * level + damping * x)


def _stribeck(x: Array, kinetic: float, excess: float, rate: float, damping: float) -> Array:
    return np.asarray(kinetic + excess * np.exp(-((x / rate) ** 2)) + damping * x)


def _slope(x: Array, y: Array) -> float:
    return float((y[-1] - y[0]) / (x[-1] - x[0]))


def _largest_jump(x: Array, y: Array) -> float:
    """Where y changes most from one point to the next."""
    i = int(np.argmax(np.abs(np.diff(y))))
    return float(0.5 * (x[i] + x[i + 1]))


def _waves(x: Array, y: Array, cycles: int) -> tuple[float, tuple[float, ...]]:
    """What is left beside the best wave of so many cycles in a turn, a sum of squares, and that wave."""
    angle = np.radians(cycles * x)
    columns = np.stack([np.ones(x.size), np.sin(angle), np.cos(angle)], axis=1)
    mean, sine, cosine = np.linalg.lstsq(columns, y)[0]
    left = y - columns @ (mean, sine, cosine)
    wave = (float(mean), float(np.hypot(sine, cosine)), float(np.arctan2(cosine, sine)), float(cycles))
    return float(left @ left), wave


_DRY_AND_VISCOUS = Shape(
    name="dry and viscous friction",
    says="dry friction of {0:.3g} and damping of {1:.3g} at 1 rad/s",
    law=_dry_and_viscous,
    start=lambda x, y: (float(abs(y).min()), _slope(x, y)),
)
_POWER = Shape(
    name="power law",
    says="{0:.3g} at 1 rad/s, with the power {1:.3g} of the rate",
    law=_power,
    start=lambda x, y: (float(y[-1] / max(abs(x[-1]), 1e-9)), 1.0),
)
_STRIBECK = Shape(
    name="Stribeck friction",
    says="dry friction of {0:.3g}, {1:.3g} more at rest, over a rate of {2:.3g} rad/s",
    law=_stribeck,
    start=lambda x, y: (float(y[0]), 0.3 * float(y[0]), float(x[len(x) // 2]), _slope(x, y)),
)
_OF_RATE = (_DRY_AND_VISCOUS, _POWER, _STRIBECK)
_OF_ANY = (
    Shape(
        name="constant",
        says="the same everywhere, {0:.3g}",
        law=_constant,
        start=lambda x, y: (float(y.mean()),),
    ),
    Shape(
        name="straight line",
        says="{0:.3g} at 0, changing by {1:+.3g} per unit",
        law=_line,
        start=lambda x, y: (float(y[0]), _slope(x, y)),
    ),
    Shape(
        name="exponential approach",
        says="settles at {0:.3g}, {1:+.3g} at the beginning, which falls to 37 % over {2:.3g}",
        law=_decay,
        start=lambda x, y: (float(y[-1]), float(y[0] - y[-1]), float(0.3 * (x[-1] - x[0]))),
    ),
    Shape(
        name="step",
        says="{0:.3g}, and {1:+.3g} beyond {2:.3g}",
        law=_step,
        start=lambda x, y: (float(y[0]), float(y[-1] - y[0]), _largest_jump(x, y)),
    ),
)
_OF_ANGLE = (
    Shape(
        name="sine wave",
        says="{0:.3g} + {1:.3g} sin({3:.3g} angle {2:+.3g} rad)",
        law=_wave,
        start=lambda x, y: min(_waves(x, y, n) for n in range(1, _MOST_CYCLES + 1))[1],
    ),
)
_ANGLES = ("base_angle", "tip_angle")
LIBRARY_LAWS = {
    (Place.INTERFACE, "rate", "dry and viscous friction"): ("coulomb_friction",),
    (Place.INTERFACE, "rate", "power law"): ("shear_thinning",),
    (Place.INTERFACE, "rate", "Stribeck friction"): ("stiction",),
    (Place.INTERFACE, "position", "step"): ("layered_tissue",),
    (Place.INTERFACE, "axial_speed", "power law"): ("speed_dependent_friction",),
    (Place.NEEDLE, "rate", "dry and viscous friction"): ("tip_drag",),
    (Place.NEEDLE, "tip_angle", "sine wave"): ("needle_curvature",),
    (Place.SENSOR, "tip_angle", "straight line"): ("tip_angle_scale", "tip_angle_bias"),
    (Place.SENSOR, "torque", "straight line"): ("torque_scale", "torque_bias"),
}
"""Effects of the library by place, variable and shape."""


def likeness_of(law: Law) -> Likeness | None:
    """The plain law that a curve looks like; None: none that is known here, or it is no curve."""
    if law.variable in ("direction", "event"):
        return None
    x, y = np.array(law.x), np.array(law.y)
    half = 0.5 * (np.array(law.high) - np.array(law.low))
    half = np.maximum(half, _LEAST_BAND * max(float(np.ptp(y)), 1e-12))
    tried = []
    for shape in _shapes_of(law):
        fitted = _fitted(shape, x, y, half)
        if fitted is not None:
            tried.append((fitted[1] + 2 * len(fitted[0]), fitted[1], shape, fitted[0]))
    if not tried:
        return None
    _, chi_square, shape, values = min(tried, key=lambda one: one[0])
    if chi_square > _WITHIN**2 * x.size:
        return None
    library = LIBRARY_LAWS.get((law.place, law.variable, shape.name), ())
    return Likeness(shape=shape.name, says=shape.says.format(*values), library=library)


def _shapes_of(law: Law) -> tuple[Shape, ...]:
    if law.variable == "rate":
        return (*_OF_RATE, *_OF_ANY[:1])
    return (*_OF_ANY, *_OF_ANGLE) if law.variable in _ANGLES else _OF_ANY


def _fitted(shape: Shape, x: Array, y: Array, half: Array) -> tuple[Array, float] | None:
    """Parameters and chi-square of a shape with fewer parameters than points."""
    start = shape.start(x, y)
    if len(start) >= x.size:
        return None
    try:
        with warnings.catch_warnings(), np.errstate(all="ignore"):
            warnings.simplefilter("ignore", OptimizeWarning)
            values, _ = curve_fit(shape.law, x, y, start, half, maxfev=_MOST_EVALUATIONS)
    except RuntimeError:
        return None
    left = (y - shape.law(x, *values)) / half
    chi_square = float(left @ left)
    return (values, chi_square) if np.isfinite(chi_square) else None
