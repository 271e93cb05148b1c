"""Readings that scatter far less than rig.yaml claims: the quickest sign of a wrong unit.

The scatter of a column in radians or newton metres is smaller by the ratio of units. Differences of a
reading separate its white part from its motion, before anything is simulated.
Motion can only increase them: whether a reading scatters too much, or slightly too little, is
decided on the residual of the nominal rig (prepare/noise/sensor_noise.py).
"""

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from diagnosis.criteria.faults import BELIEVED_SCATTER
from diagnosis.log.checks.wording import listed
from diagnosis.log.trial import Trial
from diagnosis.log.unit_hints import unit_off_by
from diagnosis.log.white_noise import white_noise

Array = NDArray[np.float64]

_ORDER = 4  # of differences: motion is in few of the largest


def far_claims(trials: Sequence[Trial], noise: Mapping[str, float]) -> dict[str, str]:
    """Warnings, by column, if the claimed noise is far above the scatter of the readings.

    Args:
      noise: claimed standard deviation by column.
    """
    warnings = {}
    for column, claim in noise.items():
        found = {trial.name: _scatter(trial[column]) for trial in trials if trial.has(column)}
        off = {name: size for name, size in found.items() if size < BELIEVED_SCATTER * claim}
        if off:
            warnings[column] = _told(column, off, claim)
    return warnings


def _scatter(values: Array) -> float:
    """Standard deviation of the white part of a reading; held readings of a slow sensor count once."""
    finite = values[np.isfinite(values)]
    fresh = np.concatenate(([True], np.diff(finite) != 0))[: finite.size]
    return white_noise([finite[fresh]], order=_ORDER)


def _told(column: str, off: Mapping[str, float], claim: float) -> str:
    name = min(off, key=lambda one: off[one])
    times = claim / max(off[name], 1e-12 * claim)
    unit = unit_off_by(column, times)
    fix = f"if it is in {unit.name}, {unit.fix}" if unit else "check its unit"
    return (
        f"{listed(off)}: {column} scatters by {off[name]:.3g} in {name}, and rig.yaml claims "
        f"{claim:.3g}, {times:.3g} times as much; {fix}; if it is filtered, log it without the filter; "
        "else correct the claim"
    )
