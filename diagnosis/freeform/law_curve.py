"""A free-form law as a curve with a band, from the numbers of its fit.

The band is that of draws from the covariance of the fit, to first order. A law and its factor share
one size: the factor is given about 1, and the size is in the law.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from diagnosis.effects.effect import Place, slopes_at
from diagnosis.fitting.fit import Fit
from diagnosis.freeform.family import VISCOUS, Family
from diagnosis.freeform.fits.free_fit import FreeFit
from diagnosis.freeform.prior import free_covariance

Array = NDArray[np.float64]

DAMPING = "damping_error"
_DRAWS, _SEED = 400, 17
_FAR_OFF = 1e3  # times the median of a curve, where a factor is held by the limit of its logarithm


@dataclass(frozen=True, kw_only=True)
class Law:
    """A free-form law as a curve with a 95 % band; arrays are (K,).

    Attributes:
      beside: effects of the library that are fitted together with it.
      shape: name of the plain law that it was fitted as; empty: a curve of any form.
      multiplies: whether it is a factor of the law before it.
    """

    place: Place
    variable: str
    title: str
    x_unit: str
    unit: str
    x: tuple[float, ...]
    y: tuple[float, ...]
    low: tuple[float, ...]
    high: tuple[float, ...]
    beside: tuple[str, ...] = ()
    shape: str = ""
    multiplies: bool = False

    @property
    def of_a_clock(self) -> bool:
        """Whether what is off is a time."""
        return self.unit == "s"


def laws_of_fit(one: FreeFit) -> list[Law]:
    """The curves of all laws of a fit: each law, then the factor that it may have."""
    own = [_times(law_of(one, curve), _damping_of(curve, one.fit)) for curve in one.curves]
    return _with_factors_about_one(own)


def law_of(one: FreeFit, family: Family | None = None) -> Law:
    """The curve of a family of a fit, by default the leading one, with a band from draws."""
    family, fit = family or one.family, one.fit
    own = np.array([owner == family.name for owner in fit.parameterization.owners])
    rng = np.random.default_rng(_SEED)
    draws = rng.multivariate_normal(fit.x, free_covariance(fit), size=_DRAWS, method="eigh")
    curves = [_points(family, values[own])[1] for values in _values_near(fit, draws)]
    ends = np.quantile(curves, [0.025, 0.975], axis=0)
    x, y = _points(family, np.array(fit.parameterization.values(fit.x))[own])
    known = _determined(y, ends)
    x, y, ends = x[known], y[known], ends[:, known]
    return Law(
        place=family.place,
        variable=family.says,
        title=family.title,
        x_unit=family.x_unit,
        unit=family.unit,
        x=_numbers(x),
        y=_numbers(y),
        low=_numbers(ends[0]),
        high=_numbers(ends[1]),
        beside=one.beside,
        shape=family.shape,
        multiplies=family.multiplies,
    )


def _damping_of(family: Family, fit: Fit) -> float:
    """What a law of damping is multiplied by: the damping of the tissue over the nominal one."""
    if family.unit != VISCOUS or family.multiplies:
        return 1.0
    own = fit.parameterization
    values = zip(own.owners, own.values(fit.x), strict=True)
    return next((value for owner, value in values if owner == DAMPING), 1.0)


def _with_factors_about_one(laws: Sequence[Law]) -> list[Law]:
    """Laws and their factors, as they follow each other, with the size of both in the law."""
    found = list[Law]()
    for law in laws:
        size = float(np.median(law.y)) if law.multiplies and found else 0.0
        if size:
            found[-1] = _times(found[-1], size)
        found.append(_times(law, 1.0 / size) if size else law)
    return found


def _times(law: Law, size: float) -> Law:
    y, low, high = (tuple(size * v for v in values) for values in (law.y, law.low, law.high))
    return replace(law, y=y, low=low if size > 0 else high, high=high if size > 0 else low)


def _determined(y: Array, ends: Array) -> NDArray[np.bool_]:
    """Mask of points that the log determines, not those of a factor that no draw moves from its limit.

    Args:
      y, ends: the curve, (K,), and its band, (2, K).
    """
    held = (ends[0] == ends[1]) & (np.abs(y) > _FAR_OFF * np.median(np.abs(y)))
    return ~held if np.ptp(ends, axis=0).any() else np.ones(y.size, bool)


def _values_near(fit: Fit, draws: Array) -> Array:
    """Parameter values of draws of the vector, to first order, within their bounds, (draws, n).

    The data tell of a level in its own unit, also where its logarithm is open.
    """
    parameters = fit.parameterization.parameters
    here = np.array(fit.parameterization.values(fit.x))
    near = here + slopes_at(parameters, fit.x) * (draws - fit.x)
    return np.clip(near, [p.low for p in parameters], [p.high for p in parameters])


def _points(family: Family, values: Array) -> tuple[Array, Array]:
    across, up = family.curve(*(float(v) for v in values))
    return np.asarray(across, float), np.asarray(up, float)


def _numbers(values: Array) -> tuple[float, ...]:
    return tuple(float(v) for v in values)
