"""Whether noise is correlated in time or from row to row, where rows are uneven: what is likelier."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from diagnosis.criteria.noise import (
    COLOUR_CHI_SQUARE,
    COLOUR_LEAST_SHARE,
    COLOUR_MOST_PARTS,
    UNEVEN_ROWS,
)
from diagnosis.prepare.noise.colour import Colour
from diagnosis.prepare.noise.colour_of_rows import ColourOfRows, even_rows
from diagnosis.prepare.noise.spectrum.noise_spectrum import noise_colour, unlikeliness

Array = NDArray[np.float64]
TimedArray = tuple[Array, Array]


def colour_in_time_or_rows(
    parts: Sequence[TimedArray],
    least_share: float = COLOUR_LEAST_SHARE,
    means_of: int = 1,
    least_chi_square: float = COLOUR_CHI_SQUARE,
    most_parts: int = COLOUR_MOST_PARTS,
) -> tuple[float, Colour] | None:
    """Standard deviation and colour of the noise in residuals; None: it may be white.

    The arguments are those of `noise_colour`.
    """
    asked = (least_share, means_of, least_chi_square, most_parts)
    in_time = noise_colour(parts, *asked)
    read = [(t[np.isfinite(v)], v[np.isfinite(v)]) for t, v in parts]
    steps = np.concatenate([np.diff(t) for t, _ in read]) if read else np.zeros(0)
    if not steps.size or means_of > 1 or not _uneven(steps):
        return in_time
    step_s = float(np.median(steps))
    found = noise_colour([(even_rows(t, step_s), v) for t, v in read], *asked)
    if found is None:
        return in_time
    of_rows = (found[0], ColourOfRows(at_steps=found[1], step_s=step_s))
    if in_time is None:
        return of_rows
    lead = unlikeliness(read, in_time[1]) - unlikeliness(read, of_rows[1])
    return of_rows if lead > COLOUR_CHI_SQUARE else in_time


def _uneven(steps_s: Array) -> bool:
    """Whether the middle half of the steps spreads by more than a share of the median."""
    low, middle, high = np.quantile(steps_s, [0.25, 0.5, 0.75])
    return bool(high - low > UNEVEN_ROWS * middle)
