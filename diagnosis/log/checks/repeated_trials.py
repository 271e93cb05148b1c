"""One recording that is listed as two trials: it would count twice, and a trial that is held out of
a fit would still be in the fit.

Two recordings never have the same noise, so equal readings are the same recording.
"""

from collections.abc import Sequence
from itertools import combinations
from pathlib import Path

import numpy as np

from diagnosis.log.trial import COLUMNS, Trial, UnusableLog

_SHARE = 1e-6  # of the range: what another number of digits changes


def refuse_repeated_trials(paths: Sequence[Path], trials: Sequence[Trial]) -> None:
    """Refuse a log that has a trial twice, whatever the names and times.

    Raises:
      UnusableLog: names both files and the fix.
    """
    for (path, one), (_, other) in combinations(zip(paths, trials, strict=True), 2):
        if _same(one, other):
            raise UnusableLog(
                f"{path.parent}: {one.name} and {other.name} have the same samples in all columns but "
                "time_s; expected each trial once; take one of the two out of rig.yaml"
            )


def _same(one: Trial, other: Trial) -> bool:
    """Whether all columns but the time agree."""
    if len(one.table) != len(other.table) or list(one.table) != list(other.table):
        return False
    return all(
        np.allclose(
            one[name],
            other[name],
            rtol=0,
            atol=_SHARE * (np.nanmax(np.abs(one[name]), initial=0.0)),
            equal_nan=True,
        )
        for name in COLUMNS[1:]
        if name in one.table
    )
