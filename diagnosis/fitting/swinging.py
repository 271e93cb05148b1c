"""Whether a sensor whose noise is taken for coloured swings at one frequency, as no noise does.

Noise that is correlated over some tenths of a second may hide what comes once in a heartbeat or in a
breath: a filter whitens most of that, but for a line in the spectrum. Of white residuals the sum over
trials of the periodograms

    sum of |sum over samples of r exp(-i w t)|^2 / samples,    r in sigma

is of Gamma's distribution with as many degrees as there are trials; the largest of many frequencies
is compared with that. How large the line is, is told by its share of the residual's variance before
whitening. Frequencies are those at which noise may not oscillate.
"""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.stats import gamma

from diagnosis.criteria.noise import (
    COLOUR_OSCILLATES_ABOVE_HZ,
    SWINGS_CHANCE,
    SWINGS_LEAST_PERIODS,
    SWINGS_SHARE,
)
from diagnosis.fitting.noise_reestimation import by_sensor, in_units_of
from diagnosis.fitting.problem import FitProblem

Array = NDArray[np.float64]
Timed = Sequence[tuple[Array, Array]]  # times, s, and residuals, (N,) each, by trial

_BIN_S = 0.05  # a fifth of the shortest period
_FINER = 4  # frequencies in 1 / duration


def swinging_where_coloured(problem: FitProblem, by_trial: Sequence[Array]) -> dict[str, float]:
    """Frequencies, Hz, at which sensors with coloured noise swing, of those that do."""
    plain = in_units_of(problem, by_trial, problem.noise.uncoloured)
    white, before = (by_sensor(problem, rows) for rows in (by_trial, plain))
    each = {s: swinging_hz(white[s], before[s]) for s in problem.noise.colour if s in white}
    return {sensor: hertz for sensor, hertz in each.items() if hertz}


def swinging_hz(white: Timed, before: Timed) -> float:
    """The frequency at which residuals swing, Hz; 0: they do not.

    Args:
      white: in sigma, whitened.
      before: in sigma, before whitening.
    """
    white, before = ([part for part in parts if part[1].size] for parts in (white, before))
    if not white:
        return 0.0
    lasting_s = max(float(np.ptp(time_s)) for time_s, _ in white)
    hertz, powers = _periodograms(white, lasting_s)
    inside = (hertz > SWINGS_LEAST_PERIODS / lasting_s) & (hertz < COLOUR_OSCILLATES_ABOVE_HZ)
    if not inside.any():
        return 0.0
    most = int(np.argmax(np.where(inside, powers.sum(axis=0), 0.0)))
    chance = np.count_nonzero(inside) * float(gamma.sf(powers[:, most].sum(), len(white)))
    _, own = _periodograms(before, lasting_s)
    share = 2.0 * own[:, most].sum() / sum(float(values @ values) for _, values in before)
    return float(hertz[most]) if chance < SWINGS_CHANCE and share > SWINGS_SHARE else 0.0


def _periodograms(parts: Timed, lasting_s: float) -> tuple[Array, Array]:
    """Frequencies, Hz, (F,), and the periodogram of each trial there, (trials, F)."""
    size = _FINER * (int(lasting_s / _BIN_S) + 1)
    found = []
    for time_s, values in parts:
        bins = ((time_s - time_s[0]) / _BIN_S).astype(int)
        sums = np.bincount(bins, weights=values, minlength=size)
        found.append(np.abs(np.fft.rfft(sums, size)) ** 2 / max(values.size, 1))
    return np.asarray(np.fft.rfftfreq(size, _BIN_S)), np.array(found)
