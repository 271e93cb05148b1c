"""The damping of the quick, sliding turn, from Table V alone and without any fit.

In any linear tissue the integral of base minus tip over a turn by A is

    integral = A D,   D = beta l (f + l / 2) / kappa,

the lag of equation (2) at unit rate, for any motion of the base. The part of the printed integral
that is due to the base's motion, to a delay or to an offset of the sensor is the same at both
depths, if the base moves in the same way. So the difference between the depths is A (D_2 - D_1),
which measures the damping of the quick, sliding turn.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

from models.lag import steady_lag_deg
from models.needle import Needle
from studies.published.experiments.base_turn import TURN_DEG
from studies.published.experiments.figures import plastisol
from studies.published.experiments.measurement import MeasuredFigure, Quantity
from studies.published.experiments.rig import STATED


@dataclass(frozen=True, kw_only=True)
class QuickDamping:
    """Damping of the quick, sliding turn / stated damping.

    Attributes:
      free_mm: assumed free length between base and tissue.
      sigma: standard deviation of `ratio`.
    """

    free_mm: float
    ratio: float
    sigma: float


def mean_delay_s(depth_mm: float, free_mm: float) -> float:
    """D of the stated model: mean delay of the tip behind the base, s."""
    return math.radians(
        steady_lag_deg(
            Needle(**dict(STATED.needle)),
            damping_n_mm_s_per_mm=STATED.tissue.damping_n_mm_s_per_mm,
            rate_rad_s=1.0,
            free_mm=free_mm,
            inserted_mm=depth_mm,
        )
    )


def quick_damping(free_mm: float, figures: Sequence[MeasuredFigure] | None = None) -> QuickDamping:
    """Damping from the two depths of Table V."""
    integrals = [f for f in figures or plastisol() if f.quantity is Quantity.INTEGRAL]
    shallow, deep = sorted(integrals, key=lambda f: f.depth_mm)
    delay = mean_delay_s(deep.depth_mm, free_mm) - mean_delay_s(shallow.depth_mm, free_mm)
    return QuickDamping(
        free_mm=free_mm,
        ratio=(deep.value - shallow.value) / (TURN_DEG * delay),
        sigma=math.hypot(deep.sigma, shallow.sigma) / (TURN_DEG * delay),
    )
