"""Signs and zeros of the columns, from the behaviour of a passive needle.

The drive does work on the needle, so torque times rate is mostly positive. The tip follows the base.
Depth grows with the axial speed. The positive direction of the base is free: it is kept.
"""

from dataclasses import dataclass
from typing import Literal

import numpy as np

from diagnosis.criteria.lab_files import SIGN_LEAST_CORRELATION, SIGN_LEAST_WORK, ZERO_SIGMA
from diagnosis.lab_files.motion import Motion
from diagnosis.lab_files.readers.lab_table import Array
from diagnosis.log.checks.binned_trial import misfit

_SAMPLES = 1500


@dataclass(frozen=True, kw_only=True)
class SignGuess:
    """A sign, and how it was found; None: the columns do not determine it."""

    sign: Literal[1, -1] | None
    reason: str


@dataclass(frozen=True, kw_only=True)
class ZeroGuess:
    """The reading of a sensor that should be 0, in its own unit, and how it was found."""

    value: float | None
    reason: str


def torque_sign(torque: Array, angle: Array) -> SignGuess:
    """Sign that makes the work on the needle positive; both (N,), in any unit, torque without offset."""
    middle = (torque[1:] + torque[:-1]) / 2
    work = middle * np.diff(angle)
    whole = float(np.nansum(np.abs(work)))
    share = float(np.nansum(work)) / whole if whole > 0 else 0.0
    if abs(share) < SIGN_LEAST_WORK:
        return SignGuess(
            sign=None,
            reason=f"net work is {100 * share:+.0f} % of the work that goes back and forth: too little",
        )
    reason = f"net work on the needle is {100 * share:+.0f} % of the work that goes back and forth"
    return SignGuess(sign=1 if share > 0 else -1, reason=reason)


def tip_sign(time_s: Array, tip: Array, base: Array) -> SignGuess:
    """Sign under which the tip is a lagging copy of the base; all (N,)."""
    good = np.isfinite(tip) & np.isfinite(base)
    even = np.linspace(time_s[0], time_s[-1], min(_SAMPLES, time_s.size))
    driving, following = (np.interp(even, time_s[good], one[good]) for one in (base, tip))
    same, opposite = misfit(driving, following, float(even[1] - even[0]))
    if max(1 - same, 1 - opposite) < SIGN_LEAST_CORRELATION:
        return SignGuess(sign=None, reason="the tip does not follow the base either way")
    percent, inverted = 100 * (1 - same), 100 * (1 - opposite)
    left = f"a lagging copy of the base explains {percent:.0f} %, with opposite sign {inverted:.0f} %"
    return SignGuess(sign=1 if same <= opposite else -1, reason=left)


def speed_sign(time_s: Array, speed: Array, depth: Array, *, depth_grows: bool) -> SignGuess:
    """Sign that makes speed positive into the tissue; depth may be the free length, which shrinks."""
    travel = np.concatenate(([0.0], np.cumsum(np.diff(time_s) * (speed[1:] + speed[:-1]) / 2)))
    moved = (depth - depth[0]) * (1 if depth_grows else -1)
    if np.ptp(travel) == 0 or np.ptp(moved) == 0:
        return SignGuess(sign=None, reason="nothing moves along the axis")
    match = float(np.corrcoef(travel, moved)[0, 1])
    if abs(match) < SIGN_LEAST_CORRELATION:
        return SignGuess(sign=None, reason=f"correlation with the axial motion is only {match:+.2f}")
    return SignGuess(
        sign=1 if match > 0 else -1, reason=f"correlation with the axial motion is {match:+.2f}"
    )


def zero_at_rest(values: Array, time_s: Array, motion: Motion, noise: float) -> ZeroGuess:
    """Mean reading of the rest at the start of a trial, if it differs from 0 significantly."""
    resting = values[motion.in_first_rest(time_s)]
    resting = resting[np.isfinite(resting)]
    if resting.size < 2:
        return ZeroGuess(value=None, reason="the trial does not start at rest")
    mean, uncertain = float(resting.mean()), noise / float(np.sqrt(resting.size))
    lasted = float(np.ptp(time_s[motion.in_first_rest(time_s)]))
    if abs(mean) <= ZERO_SIGMA * uncertain:
        return ZeroGuess(
            value=0.0, reason=f"reads 0 within its noise in the first rest ({lasted:.2g} s)"
        )
    return ZeroGuess(
        value=mean, reason=f"mean of the first rest ({lasted:.2g} s), {mean:.4g} ± {uncertain:.2g}"
    )
