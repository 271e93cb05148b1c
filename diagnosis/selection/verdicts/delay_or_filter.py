"""A sensor that is late by a delay, which is an effect of the library, or by filters, which are not.

A filter of a time constant near the interval of samples and such a delay differ by little more than
what a replay does not resolve. Every sensor has a bandwidth: beside effects that are certain, a lag that
changes readings by less than noise is no second cause, though the delay is named as what it may be.
"""

import math

import numpy as np

from diagnosis.criteria.fitting import SCATTER
from diagnosis.criteria.selection import LAG_LITTLE
from diagnosis.effects import FITTED, IMPERFECTIONS, LIBRARY
from diagnosis.selection.candidate import Candidate


def takes_for_a_filter(best: Candidate, other: Candidate) -> bool:
    """Whether the best has filters of a sensor in place of its delay, and all else as the other.

    But for stiffness and damping, which are in every fit.
    """
    mine = [FITTED[name] for name in {*best.names} - {*other.names, *SCATTER}]
    theirs = [FITTED[name] for name in {*other.names} - {*best.names, *SCATTER}]
    filters = all(e.delays_a_sensor and e.name in IMPERFECTIONS for e in mine)
    delay = len(theirs) == 1 and theirs[0].delays_a_sensor and theirs[0].name in LIBRARY
    return bool(mine) and filters and delay and {e.needs for e in mine} == {theirs[0].needs}


def delays_in_place(one: Candidate) -> tuple[str, ...]:
    """Delays of the library that make late the sensors which filters of an explanation make late."""
    late = {
        FITTED[name].needs
        for name in one.names
        if name in IMPERFECTIONS and FITTED[name].delays_a_sensor
    }
    return tuple(
        e.name
        for e in LIBRARY.values()
        if e.delays_a_sensor and e.needs in late and e.name not in one.names
    )


def lags_little(best: Candidate, other: Candidate) -> bool:
    """Whether the best has effects beside filters that do little, and the other a delay for these."""
    likelier = bool(best.named) and best.score <= other.score and takes_for_a_filter(best, other)
    little = LAG_LITTLE * math.sqrt(best.means_of)  # in sigma of a reading
    return likelier and _changes_sigma(best, {*best.names} - {*other.names}) < little


def _changes_sigma(one: Candidate, effects: set[str]) -> float:
    """Root mean square by which effects change the readings, to first order, in sigma."""
    fit = one.fit
    own = np.isin(fit.parameterization.owners, list(effects))
    changes = (rows[:, own] @ fit.x[own] for rows in fit.jacobian)
    return float(np.sqrt(sum(float(c @ c) for c in changes) / max(fit.samples, 1)))
