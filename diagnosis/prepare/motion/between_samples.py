"""The motion of the base between samples at a low rate.

Straight lines between 20 samples per second are steps of the rate, which appear in the viscous torque.
Akima's interpolation follows a smooth motion without overshooting at corners of exact samples. If two
straight parts meet between two samples, the corner is where their lines cross; if they meet at a sample,
the motion runs straight to it and on, so that noise of the slopes makes no overshoot. And it stays
between two samples unless it turns near them: a dry element would remember the reversal.

Source: H. Akima, J. ACM 17 (1970) 589.
"""

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import Akima1DInterpolator

from diagnosis.criteria.prepare import STRAIGHT_DEG

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

_FINE_S = 0.01  # a step of the replay
_RARE_S = 0.02  # samples for which STRAIGHT_DEG is; nearer ones bend by less
_FEWEST_PARTS = 2  # steps of a replay that is twice as fine
_LEAST_SAMPLES = 6


def between_samples(time_s: Array, base_deg: Array) -> tuple[Array, Array]:
    """Times and angles of the base, (M,) each, with interpolated ones between all N samples."""
    step_s = float(np.median(np.diff(time_s)))
    if time_s.size < _LEAST_SAMPLES:
        return time_s, base_deg
    parts = max(int(np.ceil(step_s / _FINE_S - 1e-6)), _FEWEST_PARTS)
    inside = time_s[:-1, None] + np.diff(time_s)[:, None] * np.arange(parts) / parts
    angles = np.asarray(Akima1DInterpolator(time_s, base_deg)(inside))
    rate = np.diff(base_deg) / np.diff(time_s)
    bent = np.abs(np.diff(rate)) * np.minimum(np.diff(time_s)[:-1], np.diff(time_s)[1:])
    straight = bent < STRAIGHT_DEG * min(step_s / _RARE_S, 1.0)
    _straighten(time_s, base_deg, straight, inside, angles)
    _turn_corners(time_s, base_deg, rate, straight, inside, angles)
    _hold_between(base_deg, rate, angles)
    return np.append(inside.ravel(), time_s[-1]), np.append(angles.ravel(), base_deg[-1])


def _straighten(time_s: Array, base_deg: Array, straight: Mask, inside: Array, angles: Array) -> None:
    """Run straight to corners at a sample, and on, in the angles, (N - 1, parts).

    Args:
      straight: mask of inner samples at which the motion hardly bends, (N - 2,).
    """
    for i in 2 + np.flatnonzero(straight[:-2] & ~straight[1:-1] & straight[2:]):
        near = slice(i - 1, i + 1)
        angles[near] = np.interp(inside[near], time_s, base_deg)


def _turn_corners(
    time_s: Array, base_deg: Array, rate: Array, straight: Mask, inside: Array, angles: Array
) -> None:
    """Insert corners into the angles, (N - 1, parts), where lines of three samples per side cross."""
    first = np.arange(2, time_s.size - 3)  # the sample before the corner
    before, after = rate[first - 1], rate[first + 1]
    bends = ~(straight[first - 1] & straight[first])
    corner = bends & straight[first - 2] & straight[first + 1]
    turned = np.where(before == after, np.inf, before - after)
    late = base_deg[first + 1] - after * (time_s[first + 1] - time_s[first]) - base_deg[first]
    wait = late / turned
    found = corner & (wait > 0) & (wait < time_s[first + 1] - time_s[first])
    for i in first[found]:
        left = base_deg[i] + rate[i - 1] * (inside[i] - time_s[i])
        right = base_deg[i + 1] + rate[i + 1] * (inside[i] - time_s[i + 1])
        at = wait[i - first[0]]
        angles[i] = np.where(inside[i] - time_s[i] < at, left, right)


def _hold_between(base_deg: Array, rate: Array, angles: Array) -> None:
    """Keep the angles, (N - 1, parts), between two samples unless the rates at these differ in sign.

    The rate before may be large, and that after, of a base that has arrived, anything near 0.
    """
    at_sample = rate[:-1] + rate[1:]  # twice
    turns = np.pad(at_sample[:-1] * at_sample[1:] < 0, 1)
    low = np.where(turns, -np.inf, np.minimum(base_deg[:-1], base_deg[1:]))
    high = np.where(turns, np.inf, np.maximum(base_deg[:-1], base_deg[1:]))
    np.clip(angles, low[:, None], high[:, None], out=angles)
