"""Values of a simulated signal between its samples.

A straight line between two steps h of a turn with the acceleration a is off by a h^2 / 8: for a fast
turn, more than the noise of an angle. Akima's interpolation follows it, and does not overshoot where a
dry torque jumps.

Source: H. Akima, J. ACM 17 (1970) 589.
"""

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import Akima1DInterpolator, make_interp_spline

Array = NDArray[np.float64]

_ON_SAMPLES = 1e-4  # of a step: rounding of logged times


def interpolated(at_s: Array, time_s: Array, values: Array) -> Array:
    """The signal, or several at once, at other times, (M,) or (M, K); beyond the ends as there.

    Args:
      at_s: times, (M,).
      time_s: times of its samples, increasing, (N,).
      values: of one signal, (N,), or of several, (N, K).
    """
    within = np.clip(at_s, time_s[0], time_s[-1])
    if _on_samples(at_s, time_s):
        return np.asarray(make_interp_spline(time_s, values, k=1)(within))
    return np.asarray(Akima1DInterpolator(time_s, values)(within))


def _on_samples(at_s: Array, time_s: Array) -> bool:
    if time_s.size <= 2:
        return True
    after = np.clip(np.searchsorted(time_s, at_s), 1, time_s.size - 1)
    off_s = np.minimum(np.abs(at_s - time_s[after - 1]), np.abs(at_s - time_s[after]))
    return bool(off_s.max() < _ON_SAMPLES * float(np.diff(time_s).min()))
