"""How much so few figures can support.

Without any fit, Table V says one thing whatever the base did, as long as it did the same
at both depths: in any linear tissue the integral of base less tip over a turn by A is

    integral = A D,   D = beta l (f + l / 2) / kappa,

the lag of equation (2) at unit rate. The base's own share of the printed integral is the
same at both depths, and so are a delay and an offset of the sensor: the difference of the
two depths is A (D_2 - D_1), which measures the damping of the quick, sliding turn.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq
from scipy.stats import chi2

from models.lag import steady_lag_deg
from models.needle import Needle
from studies.published.experiments.figures import FRACTION, Figure, Measure, plastisol
from studies.published.experiments.rig import STATED, TURN_DEG
from studies.published.fitting.fit import Fit
from studies.published.selection.verdict import LEAST_CHANCE, Verdict, contradiction

_FRACTIONS = (0.03, FRACTION, 0.1, 0.2)
_LARGEST_FRACTION = 2.0


@dataclass(frozen=True, kw_only=True)
class Share:
    """Damping of the quick, sliding turn over the stated one, from Table V alone."""

    free_mm: float
    value: float
    spread: float


def mean_delay_s(depth_mm: float, free_mm: float) -> float:
    """D of the stated model: by how much the tip comes after the base, in the mean, s."""
    return math.radians(
        steady_lag_deg(
            Needle(**dict(STATED.needle)),
            damping_n_mm_s_per_mm=STATED.tissue.damping_n_mm_s_per_mm,
            rate_rad_s=1.0,
            free_mm=free_mm,
            inserted_mm=depth_mm,
        )
    )


def damping_share(free_mm: float, figures: Sequence[Figure] | None = None) -> Share:
    """What the two depths of Table V say of the damping, whatever the base did."""
    integrals = [f for f in figures or plastisol() if f.measure is Measure.INTEGRAL]
    shallow, deep = sorted(integrals, key=lambda f: f.depth_mm)
    delay = mean_delay_s(deep.depth_mm, free_mm) - mean_delay_s(shallow.depth_mm, free_mm)
    return Share(
        free_mm=free_mm,
        value=(deep.value - shallow.value) / (TURN_DEG * delay),
        spread=math.hypot(deep.spread, shallow.spread) / (TURN_DEG * delay),
    )


def chi_square_at(fit: Fit, fraction: float) -> float:
    """Chi-square of a fit of plastisol, not fitted anew, had Tables IV and V that spread."""
    new = np.array([f.spread for f in plastisol(fraction)])
    old = np.array([f.spread for f in fit.figures])
    return float(np.square(fit.missed * old / new).sum())


def scatter_needed(fit: Fit) -> float:
    """Spread of Tables IV and V at which a fit would meet them; infinite: none would do.

    The fit is not made anew, so for a fitted one this is the most that is needed.
    """
    limit = float(chi2.isf(LEAST_CHANCE, fit.freedom))

    def excess(log_fraction: float) -> float:
        return chi_square_at(fit, math.exp(log_fraction)) - limit

    low, high = math.log(1e-4), math.log(_LARGEST_FRACTION)
    if excess(high) > 0:
        return math.inf
    return math.exp(float(brentq(excess, low, high))) if excess(low) > 0 else 0.0


def sets_that_pass(fits: Sequence[Fit]) -> dict[float, int]:
    """Sets of effects that meet the figures, by the spread of Tables IV and V; at the least."""
    return {
        fraction: len({f.hypothesis.names for f in fits if _passes(f, fraction)})
        for fraction in _FRACTIONS
    }


def _passes(fit: Fit, fraction: float) -> bool:
    chance = float(chi2.sf(chi_square_at(fit, fraction), fit.freedom)) if fit.freedom > 0 else 0.0
    return chance >= LEAST_CHANCE and not contradiction(fit)


def price(figures: int) -> dict[int, float]:
    """What AICc asks for k parameters fitted to some figures; where it is finite."""
    return {k: 2 * k + 2 * k * (k + 1) / (figures - k - 1) for k in range(1, figures - 1)}


def odds(verdict: Verdict) -> float:
    """Of the best accepted set of effects to the next one; 1 if there is none."""
    others = [f.aicc for f in verdict.accepted if f.hypothesis.names != verdict.best.hypothesis.names]
    return math.exp(0.5 * (min(others) - verdict.best.aicc)) if others else 1.0
