"""Low-pass filters of a sensor: first order, Butterworth of second order, moving average.

A filter of first order with the pole p = -1 / tau shows

    d(shown)/dt = p (shown - value)

and that of second order with the corner w has the poles w (-1 +- i) / sqrt(2). Its partial fractions are
two filters of first order with complex poles, so that it shows the real part of

    2 c (what the filter of the pole p = w (-1 + i) / sqrt(2) shows),    c = w^2 / (-p (p - conj(p)))

A moving average shows the mean of the last T seconds. All are exact for values that are linear between
even times, and begin at rest. Slow values are shown late: by tau, by sqrt(2) / w, by T / 2.
"""

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import cumulative_trapezoid
from scipy.signal import lfilter

Array = NDArray[np.float64]

_TURN = (-1 + 1j) / np.sqrt(2)


def first_order(time_s: Array, values: Array, time_constant_s: float) -> Array:
    """Values behind a filter of first order, (N,).

    Args:
      time_s: even times, (N,).
      time_constant_s: tau, s; 0: no filter.
    """
    if time_constant_s <= 0.0 or values.size < 2:
        return values
    return np.asarray(_behind_pole(time_s, values, -1.0 / time_constant_s).real)


def butterworth(time_s: Array, values: Array, time_constant_s: float) -> Array:
    """Values behind a Butterworth filter of second order, (N,).

    Args:
      time_s: even times, (N,).
      time_constant_s: 1 / w, s; 0: no filter.
    """
    if time_constant_s <= 0.0 or values.size < 2:
        return values
    corner = 1.0 / time_constant_s
    pole = corner * _TURN
    share = corner**2 / (-pole * (pole - pole.conjugate()))
    return np.asarray(2.0 * (share * _behind_pole(time_s, values, pole)).real)


def moving_average(time_s: Array, values: Array, window_s: float) -> Array:
    """Means of the last `window_s` seconds, (N,); 0: no filter.

    Args:
      time_s: even times, (N,).
    """
    if window_s <= 0.0 or values.size < 2:
        return values
    step_s = float(time_s[1] - time_s[0])
    area = np.asarray(cumulative_trapezoid(values, dx=step_s, initial=0), float)
    at = (time_s - time_s[0] - window_s) / step_s
    first = np.clip(np.floor(at).astype(int), 0, values.size - 2)
    part = np.maximum(at, 0.0) - first
    rise = values[first + 1] - values[first]
    before = area[first] + step_s * (part * values[first] + 0.5 * part**2 * rise)
    still = np.maximum(-at, 0.0) * step_s * values[0]
    return np.asarray((area - before + still) / window_s)


def _behind_pole(time_s: Array, values: Array, pole: complex) -> NDArray[np.complex128]:
    """Values behind a filter of first order whose pole may be complex, (N,)."""
    step = -pole * (time_s[1] - time_s[0])
    decay = np.exp(-step)
    ramp = -np.expm1(-step) / step
    shown, _ = lfilter([1.0 - ramp, ramp - decay], [1.0, -decay], values, zi=[ramp * values[0]])
    return np.asarray(shown, complex)
