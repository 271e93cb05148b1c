"""White noise of a signal, from its own differences. Only this module estimates it.

Differences of order k remove a slow signal almost completely; those of white noise have the
standard deviation sqrt(binom(2k, k)) sigma, if times are even. If they are not, divided differences
remove the signal, and those of white noise have that of the norm of their weights. Since fast motion
may remain in the largest of them, only the smaller ones are used, whose root mean square is known for a
normal distribution:

    order 1  for a residual that is white already: most efficient
    order 2  for a reading, whose motion remains in a tenth of them
    order 4  for measured minus nominal, whatever the nominal model lacks
"""

from collections.abc import Sequence

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import NDArray

from diagnosis.criteria.prepare import LEAST_DIFFERENCES

Array = NDArray[np.float64]

# Root mean square of a standard normal distribution within its central share, by order.
_CENTRAL_SHARE = {1: 1.0, 2: 0.9, 4: 0.75}
_CENTRAL_RMS = {1: 1.0, 2: 1 / 1.267, 4: 0.60706}
_CORE_SHARE, _CORE_RMS = _CENTRAL_SHARE[4], _CENTRAL_RMS[4]


def white_noise(parts: Sequence[Array], *, order: int, times_s: Sequence[Array] = ()) -> float:
    """Standard deviation of the white part of signals, in their unit.

    Args:
      parts: signals, (N,) each; values that are not finite are left out.
      order: order of the differences: 1, 2 or 4.
      times_s: times of the samples, s, (N,) each; none: they are even.

    Returns:
      Standard deviation; NaN from fewer than 20 differences.
    """
    times_s = times_s or [np.arange(values.size, dtype=float) for values in parts]
    each = [_differences(t, v, order) for t, v in zip(times_s, parts, strict=True)]
    sizes = np.sort(np.abs(np.concatenate(each))) if each else np.zeros(0)
    if sizes.size < LEAST_DIFFERENCES:
        return float("nan")
    kept = sizes[: max(1, round(_CENTRAL_SHARE[order] * sizes.size))]
    rms = float(np.sqrt(np.mean(kept**2)))
    return rms / _CENTRAL_RMS[order]


def heaviness(parts: Sequence[Array]) -> float:
    """Standard deviation of white noise / that of its core, at least 1: of normal noise it is 1.

    Readings and their first differences both have to tell it: single jumps are far off in differences
    alone, and what a model lacks is far off in readings alone.

    Args:
      parts: residuals, (N,) each; values that are not finite are left out.
    """
    finite = [values[np.isfinite(values)] for values in parts]
    each = (finite, [np.diff(values) for values in finite])
    return max(1.0, min(_of_its_core(np.concatenate(own)) for own in each if finite))


def _of_its_core(values: Array) -> float:
    sizes = np.sort(np.abs(values))
    core = sizes[: round(_CORE_SHARE * sizes.size)]
    if sizes.size < LEAST_DIFFERENCES or core[-1] == 0:
        return 1.0
    return float(np.sqrt(np.mean(sizes**2) / np.mean(core**2)) * _CORE_RMS)


def _differences(time_s: Array, values: Array, order: int) -> Array:
    """Divided differences, (M,), as multiples of which white noise keeps its standard deviation."""
    read = np.isfinite(values)
    if np.count_nonzero(read) <= order:
        return np.zeros(0)
    at, own = (sliding_window_view(row[read], order + 1) for row in (time_s, values))
    apart = at[:, :, None] - at[:, None, :] + np.eye(order + 1)
    weights = 1.0 / apart.prod(axis=2)
    return np.asarray((weights * own).sum(axis=1) / np.linalg.norm(weights, axis=1))
