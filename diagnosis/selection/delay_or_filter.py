"""A sensor that is late by a delay, which is an effect of the library, or by filters, which are not.

A filter of a time constant near the interval of samples and such a delay differ by little more than
what a replay does not resolve.
"""

from diagnosis.effects import FITTED, IMPERFECTIONS, LIBRARY
from diagnosis.selection.candidate import Candidate


def takes_for_a_filter(best: Candidate, other: Candidate) -> bool:
    """Whether the best has filters of a sensor in place of its delay, and all else as the other."""
    mine = [FITTED[name] for name in {*best.names} - {*other.names}]
    theirs = [FITTED[name] for name in {*other.names} - {*best.names}]
    filters = all(e.delays_a_sensor and e.name in IMPERFECTIONS for e in mine)
    delay = len(theirs) == 1 and theirs[0].delays_a_sensor and theirs[0].name in LIBRARY
    return bool(mine) and filters and delay and {e.needs for e in mine} == {theirs[0].needs}
