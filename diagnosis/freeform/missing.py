"""What the log tells about an effect that the library lacks: its place, its variable and its law.

Families are weighted by the gap g that they leave on trials that their fits have not seen,

    weight = [(FLOOR + g^2 - 1) (FLOOR + r^2 - 1)]^(-1 / PATIENCE) exp(-freedom / FREEDOM),

where r is the gap on the trials of the fit (over the least of these, if that is below the noise):
where few trials tell of a law, leaving one out says little. Far above the noise a law that leaves 10 %
more than another has a seventh of its weight by either, and near the noise, where laws are nearly
true, 2 % decide as much. A likelihood would decide more sharply; but no family is the true law, and
the best of them may be so by chance. Places that no family favours keep a small probability. The
library's nearest explanation, which has no place for what is missing, counts for all places alike:
where it leaves less than every family, none of them is likely. Of a single trial both gaps are one,
and count as one.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from diagnosis.criteria.fitting import GAP_LIMIT
from diagnosis.criteria.freeform import CLOSED_GAP, FREE_LAW_GAIN, FREE_LAW_LEAVES
from diagnosis.effects.effect import Place, slopes_at
from diagnosis.fitting.fit import Fit
from diagnosis.freeform.family import VISCOUS, Family
from diagnosis.freeform.fits.checked import share_told
from diagnosis.freeform.fits.free_fit import FreeFit
from diagnosis.freeform.prior import free_covariance, well_determined

Array = NDArray[np.float64]

PATIENCE, FREEDOM = 0.1, 4.0
FLOOR = 0.1  # variance beyond the noise, of that of the noise, that hardly counts
DAMPING = "damping_error"
COMPANION = 4.0  # parameters that an effect, or a law, beside a law counts for: two things missing
SECOND = 0.5  # of the probability of the place of a law, for that of one beside it
CHOICE = 2.0  # parameters that the choice of a plain law, among some, counts for
LEAST_WEIGHT = 0.01
_DRAWS, _SEED = 400, 17
_FAR_OFF = 1e3  # times the median of a curve, where a factor is held by the limit of its logarithm


@dataclass(frozen=True, kw_only=True)
class Dependence:
    """A variable, and the gap that its best law leaves.

    Attributes:
      title: the quantity that the law gives.
      place: where it acts.
      decimated: whether the gap is that of the decimated log: its samples are means, whose noise is
        less, so gaps are larger, and compare among themselves alone.
    """

    variable: str
    gap_after: float
    title: str
    place: Place
    decimated: bool = False


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


@dataclass(frozen=True, kw_only=True, eq=False)
class Missing:
    """What the log tells about an effect that the library lacks.

    Attributes:
      place: probabilities of places.
      depends_on: variables, in the order of the gaps that their laws leave.
      law: the law that leaves the smallest gap; None: none leaves clearly less than the library.
      beside: laws that are fitted together with it, and factors of these and of it.
      best: the fit of that law.
      closed: whether the law leaves little more than noise.
      told_share: share of the readings for which trials other than their own tell the law.
    """

    place: Mapping[Place, float]
    depends_on: tuple[Dependence, ...]
    law: Law | None
    best: FreeFit
    closed: bool
    told_share: float = 1.0
    beside: tuple[Law, ...] = ()


def missing_of(fits: Sequence[FreeFit], nearest_gap: float, *, one_trial: bool = False) -> Missing:
    """Summarise free-form fits.

    Args:
      nearest_gap: gap of the library's nearest explanation, on unseen trials.
      one_trial: whether the log has one trial only, so that none is unseen.
    """
    ranked = likelier_first(fits)
    best = ranked[0]
    helps = best.final and _leaves_clearly_less(best.gap_after, nearest_gap)
    told = [_times(law_of(best, own), _damping_of(own, best.fit)) for own in best.told] if helps else []
    laws = _with_factors_about_one(told)
    return Missing(
        place=_places(fits, nearest_gap, 0.5 if one_trial else 1.0),
        depends_on=_dependences(ranked),
        law=laws[0] if laws else None,
        beside=tuple(laws[1:]),
        best=best,
        closed=helps and best.gap_after <= CLOSED_GAP,
        told_share=share_told(best),
    )


def _leaves_clearly_less(gap: float, nearest_gap: float) -> bool:
    """Whether a law does, than the library; near the noise that shows in what is left beyond it."""
    beyond, nearest = (max(one**2 - 1.0, 0.0) for one in (gap, nearest_gap))
    near = nearest_gap > GAP_LIMIT and beyond < FREE_LAW_LEAVES * nearest
    return gap < FREE_LAW_GAIN * nearest_gap or near


def likelier_first(fits: Sequence[FreeFit]) -> list[FreeFit]:
    """Fits to the log itself before others, and of these the likelier ones first."""
    least = least_gap(fits)
    return sorted(fits, key=lambda f: (not f.final, -_log_weight(f, least)))


def least_gap(fits: Sequence[FreeFit]) -> float:
    """Of the fits to the log itself, on their own trials."""
    return min((f.fit.gap for f in fits if f.final), default=1.0)


def _places(fits: Sequence[FreeFit], nearest_gap: float, share: float) -> dict[Place, float]:
    """Probabilities of places, each by the best family that may be there.

    Args:
      share: by which logarithms of weights count.
    """
    least = least_gap(fits)
    logs = [share * _log_weight(f, least) for f in fits]
    own = nearest_gap / min(least, 1.0) if least > 0.0 else 1.0
    of_library = share * (_log_gap_weight(nearest_gap) + _log_gap_weight(own))
    best = max(*logs, of_library)
    everywhere = LEAST_WEIGHT + math.exp(of_library - best)
    most = dict.fromkeys(Place, 0.0)
    for one, log in zip(fits, logs, strict=True):
        for family in one.families:
            whole = 1.0 if family is one.family else SECOND
            for place, own_share in family.places.items():
                most[place] = max(most[place], whole * own_share * math.exp(log - best))
    weights = {place: everywhere + weight for place, weight in most.items()}
    return {place: weight / sum(weights.values()) for place, weight in weights.items()}


def _log_weight(one: FreeFit, least: float) -> float:
    freedom = sum(well_determined(family, one.fit) for family in one.families)
    freedom += COMPANION * (len(one.beside) + len(one.others))
    freedom += CHOICE * bool(one.family.shape)
    above = one.fit.gap / min(least, 1.0) if least > 0.0 else 1.0
    return _log_gap_weight(one.gap_after) + _log_gap_weight(above) - freedom / FREEDOM


def _log_gap_weight(gap: float) -> float:
    return -math.log(FLOOR + max(gap**2 - 1.0, 0.0)) / PATIENCE


def _dependences(ranked: Sequence[FreeFit]) -> tuple[Dependence, ...]:
    """The variable of the best fit, then the others in the order of their gaps."""
    found: dict[str, Dependence] = {}
    for one, family in ((fit, own) for fit in ranked for own in fit.told):
        found.setdefault(
            family.says,
            Dependence(
                variable=family.says,
                gap_after=one.gap_after,
                title=family.title,
                place=family.place,
                decimated=not one.final,
            ),
        )
    first, *others = found.values()
    return (first, *sorted(others, key=lambda one: one.gap_after))


def law_of(one: FreeFit, family: Family | None = None) -> Law:
    """The curve of a family of a fit, by default the leading one, with a band from draws."""
    family, fit = family or one.family, one.fit
    own = np.array([owner == family.name for owner in fit.parameterization.owners])
    rng = np.random.default_rng(_SEED)
    draws = rng.multivariate_normal(fit.x, free_covariance(fit), size=_DRAWS, method="eigh")
    curves = [_points(family, values[own])[1] for values in _values_near(fit, draws)]
    ends = np.quantile(curves, [0.025, 0.975], axis=0)
    x, y = _points(family, np.array(fit.parameterization.values(fit.x))[own])
    told = _told(y, ends)
    x, y, ends = x[told], y[told], ends[:, told]
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


def _told(y: Array, ends: Array) -> NDArray[np.bool_]:
    """Mask of points that the log tells of, not those of a factor that no draw moves from its limit.

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
