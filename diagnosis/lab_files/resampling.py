"""Columns with separate clocks at common times, only if a rate is stated.

A signal that is sampled more often than wanted passes a linear-phase low-pass filter (FIR, zero delay)
before decimation, so that nothing above half the new rate is aliased. One that is sampled
less often is interpolated linearly. Pauses stay: no reading is invented across them.
"""

import numpy as np
from numpy.typing import NDArray
from scipy.signal import resample_poly

from diagnosis.criteria.prepare import GAP_STEPS
from diagnosis.lab_files.readers.lab_table import Array


def rate_hz(time_s: Array) -> float:
    """Samples per second, from the median step."""
    return 1 / max(float(np.median(np.diff(time_s))), 1e-12)


def resampled(time_s: Array, values: Array, wanted_s: Array, *, across_gaps: bool) -> Array:
    """A signal at evenly spaced times.

    Args:
      time_s, values: samples on its own clock, (N,); values that are not finite are left out.
      wanted_s: evenly spaced, (M,).
      across_gaps: interpolate across pauses, too, for signals that move slowly or drive the replay.

    Returns:
      Values, (M,); NaN outside of its own times, and in pauses unless `across_gaps`.
    """
    good = np.isfinite(values) & np.isfinite(time_s)
    time_s, values = time_s[good], values[good]
    if time_s.size < 2:
        return np.full(wanted_s.size, np.nan)
    step_s = float(wanted_s[1] - wanted_s[0])
    keep = decimation(time_s, 1 / step_s)
    found = np.interp(wanted_s, time_s, values)
    if keep > 1:
        fine = wanted_s[0] + step_s / keep * np.arange(keep * (wanted_s.size - 1) + 1)
        found = resample_poly(np.interp(fine, time_s, values), 1, keep, padtype="line")
    slack = step_s / 2
    outside = (wanted_s < time_s[0] - slack) | (wanted_s > time_s[-1] + slack)
    if not across_gaps:
        outside |= _in_gap(time_s, wanted_s, max(1 / rate_hz(time_s), step_s))
    return np.where(outside, np.nan, found)


def decimation(time_s: Array, wanted_hz: float) -> int:
    """Number of original samples per wanted one."""
    return max(1, round(rate_hz(time_s) / wanted_hz))


def told(time_s: Array, wanted_hz: float) -> str:
    """The resampling of a signal, in words."""
    own = rate_hz(time_s)
    if decimation(time_s, wanted_hz) > 1:
        return f"{own:.4g} to {wanted_hz:.4g} Hz, low-pass below {wanted_hz / 2:.4g} Hz without delay"
    return f"{own:.4g} to {wanted_hz:.4g} Hz, interpolated by straight lines"


def _in_gap(time_s: Array, wanted_s: Array, usual_s: float) -> NDArray[np.bool_]:
    """Mask of times between two samples that are far apart, and near neither."""
    after = np.clip(np.searchsorted(time_s, wanted_s), 1, time_s.size - 1)
    before_s, after_s = time_s[after - 1], time_s[after]
    alone = np.minimum(np.abs(wanted_s - before_s), np.abs(after_s - wanted_s)) > usual_s / 2
    return np.asarray((after_s - before_s > GAP_STEPS * usual_s) & alone)
