"""One fast turn by our needle, by the native needle and by the closed form.

As in Fig. 5: the base turns by 90 deg in 0.3 s, 20 cm deep, and is then held. The native
needle's error has two parts of known size, both by t theta_tt <= 99 deg/s on this turn, with
t from the start of each of its two ramps (50 mm free: 70 deg/s):

    lumping      a^2 beta / (12 kappa) |t theta_tt|                        0.0011 deg
    steps        h^2 / 2 |t theta_ttt / 3 + t^2 theta_tttt / 8|            0.0016 deg

the second for the extrapolated steps of backward Euler, h = 5 ms.
"""

from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import NDArray

from sim.needles.run import Run
from sim.simulation import simulate
from studies.crosscheck import motion, native_needle
from studies.crosscheck.findings import Check

Array = NDArray[np.float64]

FREE_MM = (0.0, 50.0)
BOUND_DEG = 0.02
NATIVE_BOUND_DEG = 0.005


@dataclass(frozen=True, kw_only=True)
class Turn:
    """The tip of all three, deg, (N,), at the times of our needle's run."""

    run: Run
    native_tip_deg: Array
    exact_tip_deg: Array


@cache
def turned(free_mm: float) -> Turn:
    """The turn at the default discretisation; simulated once."""
    setup = motion.viscous_setup(free_mm=free_mm)
    run = simulate([setup], motion.fast_turn(free_mm=free_mm), keep_shape=True)[0]
    base = np.radians(run.inputs.drive)
    native = native_needle.tip_rad(motion.closed_form(setup), run.time_s, base)
    return Turn(run=run, native_tip_deg=np.degrees(native), exact_tip_deg=motion.exact_tip_deg(run))


def check_fast_turn() -> list[Check]:
    """All three against one another, without and with free length."""
    return [check for free in FREE_MM for check in compare(turned(free))]


def compare(turn: Turn) -> list[Check]:
    """The largest differences of the tip over a turn."""
    ours, native, exact = turn.run.tip_deg, turn.native_tip_deg, turn.exact_tip_deg
    both = BOUND_DEG + NATIVE_BOUND_DEG
    compared = (
        ("tip", ours - exact, BOUND_DEG, "defaults: tip error <= 0.02 deg"),
        (
            "tip without callbacks",
            native - exact,
            NATIVE_BOUND_DEG,
            "lumping 0.0011 and steps 0.0016 deg",
        ),
        ("tip with and without callbacks", ours - native, both, "the two bounds above, added"),
    )
    case = f"on the 20 cm turn, {turn.run.setup.free_mm:g} mm free"
    return [
        Check(name=f"{what} {case}", value=float(np.abs(off).max()), unit="deg", high=bound, why=why)
        for what, off, bound, why in compared
    ]
