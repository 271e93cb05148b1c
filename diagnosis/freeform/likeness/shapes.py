"""Plain laws that a curve may resemble: of any variable, of a rate, of an angle.

Each is y(x) with few parameters, and a start for a fit to the points of a curve.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

_STEP_WIDTH = 0.03
"""Of the range: less than from one point to the next, not so steep that no fit finds it."""
LEVEL, LINE = "constant", "straight line"
"""Name of the law that does not depend on its variable."""
_MOST_CYCLES = 4  # of a wave in one turn, from which a fit starts
_WHOLE = 1e-6  # off a whole number of cycles: none


@dataclass(frozen=True, kw_only=True)
class Shape:
    """A plain law.

    Attributes:
      says: the law in words, with values of the parameters in braces, by position; {x} and {y} are units
        after a number, or nothing, {per} is that of x alone, {variable} is what x is.
      law: y from x and the parameters.
      start: starting values of the parameters, from x and y.
      low: least values of the parameters; empty: they may be any.
    """

    name: str
    says: str
    law: Callable[..., Array]
    start: Callable[[Array, Array], tuple[float, ...]]
    low: tuple[float, ...] = ()


def _constant(x: Array, a: float) -> Array:
    return np.full(x.shape, a)


def _line(x: Array, a: float, b: float) -> Array:
    return a + b * x


def _decay(x: Array, a: float, b: float, tau: float) -> Array:
    return np.asarray(a + b * np.exp(-(x - x[0]) / tau))


def _step(x: Array, a: float, b: float, at: float) -> Array:
    width = _STEP_WIDTH * (x[-1] - x[0])
    return np.asarray(a + 0.5 * b * (1.0 + np.tanh((x - at) / width)))


def _wave(x: Array, a: float, b: float, phase_deg: float, cycles: float) -> Array:
    return np.asarray(a + b * np.sin(np.radians(cycles * x + phase_deg)))


def _parabola(x: Array, a: float, b: float, c: float) -> Array:
    return a + b * x + c * x**2


def _cubic(x: Array, a: float, b: float, c: float) -> Array:
    return a + b * x + c * x**3


def _of_size(x: Array, a: float, b: float) -> Array:
    return a + b * np.abs(x)


def _hyperbola(x: Array, a: float, half: float) -> Array:
    return np.asarray(a / (1.0 + np.abs(x) / half))


def _power(x: Array, a: float, p: float) -> Array:
    return np.asarray(a * np.abs(x) ** p)


def _dry_and_viscous(x: Array, level: float, damping: float) -> Array:
    return np.asarray(np.sign(x) * level + damping * x)


def _stribeck(x: Array, kinetic: float, excess: float, rate: float, damping: float) -> Array:
    return np.asarray(kinetic + excess * np.exp(-((x / rate) ** 2)) + damping * x)


def _slope(x: Array, y: Array) -> float:
    return float((y[-1] - y[0]) / (x[-1] - x[0]))


def _middle(x: Array) -> float:
    return float(abs(x[len(x) // 2]))


def _largest_jump(x: Array, y: Array) -> float:
    """The x at which y changes most from one point to the next."""
    i = int(np.argmax(np.abs(np.diff(y))))
    return float(0.5 * (x[i] + x[i + 1]))


def _waves(x: Array, y: Array, cycles: int) -> tuple[float, tuple[float, ...]]:
    """Residual sum of squares for the best wave of so many cycles per turn, and that wave."""
    angle = np.radians(cycles * x)
    columns = np.stack([np.ones(x.size), np.sin(angle), np.cos(angle)], axis=1)
    mean, sine, cosine = np.linalg.lstsq(columns, y)[0]
    left = y - columns @ (mean, sine, cosine)
    phase_deg = float(np.degrees(np.arctan2(cosine, sine)))
    wave = (float(mean), float(np.hypot(sine, cosine)), phase_deg, float(cycles))
    return float(left @ left), wave


_DRY_AND_VISCOUS = Shape(
    name="dry and viscous friction",
    says="dry friction of {0:.3g}{y} and damping of {1:.3g}{y} at 1 rad/s",
    law=_dry_and_viscous,
    start=lambda x, y: (float(abs(y).min()), _slope(x, y)),
)
_POWER = Shape(
    name="power law",
    says="{0:.3g}{y} at 1 rad/s, with the power {1:.3g} of the rate",
    law=_power,
    start=lambda x, y: (float(y[-1] / max(abs(x[-1]), 1e-9)), 1.0),
)
_STRIBECK = Shape(
    name="Stribeck friction",
    says="dry friction of {0:.3g}{y}, {1:.3g}{y} more at rest, over a rate of {2:.3g} rad/s",
    law=_stribeck,
    start=lambda x, y: (*(share * float(abs(y[0])) for share in (1.0, 0.3)), _middle(x), _slope(x, y)),
    low=(0.0, 0.0, 0.0, -np.inf),
)
OF_RATE = (_DRY_AND_VISCOUS, _POWER, _STRIBECK)
OF_ANY = (
    Shape(
        name=LEVEL,
        says="the same everywhere, {0:.3g}{y}",
        law=_constant,
        start=lambda x, y: (float(y.mean()),),
    ),
    Shape(
        name=LINE,
        says="{0:.3g}{y} at 0, changing by {1:+.3g}{y} per {per}",
        law=_line,
        start=lambda x, y: (float(y[0]), _slope(x, y)),
    ),
    Shape(
        name="parabola",
        says="({0:.3g} {1:+.3g} x {2:+.3g} x²){y}, where x is {variable}",
        law=_parabola,
        start=lambda x, y: tuple(np.polynomial.polynomial.polyfit(x, y, 2)),
    ),
    Shape(
        name="cubic",
        says="({0:.3g} {1:+.3g} x {2:+.3g} x³){y}, where x is {variable}",
        law=_cubic,
        start=lambda x, y: tuple(np.polynomial.polynomial.polyfit(x, y, (0, 1, 3))[[0, 1, 3]]),
    ),
    Shape(
        name="hyperbola",
        says="{0:.3g}{y} at 0, half of it at {1:.3g}{x}",
        law=_hyperbola,
        start=lambda x, y: (float(y[np.argmin(np.abs(x))]), float(0.3 * np.abs(x).max())),
        low=(-np.inf, 0.0),
    ),
    Shape(
        name="exponential approach",
        says="approaches {0:.3g}{y}: {1:+.3g}{y} off it at first, a factor e less after each {2:.3g}{x}",
        law=_decay,
        start=lambda x, y: (float(y[-1]), float(y[0] - y[-1]), float(0.3 * (x[-1] - x[0]))),
        low=(-np.inf, -np.inf, 0.0),
    ),
    Shape(
        name="step",
        says="{0:.3g}{y}, and {1:+.3g}{y} beyond {2:.3g}{x}",
        law=_step,
        start=lambda x, y: (float(y[0]), float(y[-1] - y[0]), _largest_jump(x, y)),
    ),
)
OF_BOTH_SIGNS = (
    Shape(
        name="line in the size of the variable",
        says="{0:.3g}{y} at 0, changing by {1:+.3g}{y} per {per} either way",
        law=_of_size,
        start=lambda x, y: (float(y[np.argmin(np.abs(x))]), float(np.polyfit(np.abs(x), y, 1)[0])),
    ),
)
_WAVE = Shape(
    name="sine wave",
    says="{0:.3g}{y} + {1:.3g}{y} times sin({3:.3g} angle {2:+.0f} deg)",
    law=_wave,
    start=lambda x, y: min(_waves(x, y, n) for n in range(1, _MOST_CYCLES + 1))[1],
)


def of_angle(x: Array) -> tuple[Shape, ...]:
    """Waves of a curve over an angle, deg: of whole numbers of cycles in a turn, and of any number.

    Places that are even parts of a whole part of a turn are those of a curve that repeats with it.
    """
    cycles = {*range(1, _MOST_CYCLES + 1)}
    repeats = 360.0 / (x.size * float(np.mean(np.diff(x))))
    if round(repeats) >= 1 and abs(repeats - round(repeats)) < _WHOLE:
        cycles.add(round(repeats))
    return (*(_whole_waves(n) for n in sorted(cycles)), _WAVE)


def _whole_waves(cycles: int) -> Shape:
    angle = "angle" if cycles == 1 else f"{cycles} angle"
    return Shape(
        name=_WAVE.name,
        says=f"{{0:.3g}}{{y}} + {{1:.3g}}{{y}} times sin({angle} {{2:+.0f}} deg)",
        law=partial(_wave, cycles=cycles),
        start=lambda x, y: _waves(x, y, cycles)[1][:3],
    )
