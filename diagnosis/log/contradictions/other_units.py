"""One trial in another unit than the others.

Two independent signs have to agree: it scatters less than rig.yaml claims by the ratio of two units,
where other trials scatter as claimed, and it swings less than in those trials by the same ratio. A base
that does both more is no sign: one that turns fast between two samples scatters the more the farther
it swings.
"""

from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np

from diagnosis.criteria.checks import OTHER_UNIT_SWING
from diagnosis.log.faults.scatter import agrees, scatter
from diagnosis.log.trial import SENSORS, Trial, UnusableLog
from diagnosis.log.unit_hints import OtherUnit, unit_off_by

_BASE = "base_angle_deg"


def refuse_other_units(
    paths: Sequence[Path], trials: Sequence[Trial], noise: Mapping[str, float]
) -> None:
    """Refuse a log of which one trial has a column in another unit than the other trials.

    Args:
      paths: files of the trials, for the message.
      noise: claimed standard deviation by column.

    Raises:
      UnusableLog: names the file, the column, the unit and the factor.
    """
    for column in (_BASE, *SENSORS):
        having = [(path, one) for path, one in zip(paths, trials, strict=True) if one.has(column)]
        if not noise[column] > 0:
            continue
        as_claimed = [one for _, one in having if agrees(scatter(one[column]), noise[column])]
        for path, trial in having if as_claimed else ():
            unit = _other_unit(trial, column, as_claimed, noise[column])
            if unit is not None:
                raise UnusableLog(
                    f"{path}: {column} seems to be in {unit.name}: it scatters and swings about "
                    f"{unit.factor:.3g} times less than in {as_claimed[0].name}; expected the unit in "
                    f"the column's name in all trials; {unit.fix}"
                )


def _other_unit(trial: Trial, column: str, others: Sequence[Trial], claim: float) -> OtherUnit | None:
    """The unit that both the scatter and the swing of a column speak of; None: there is none."""
    found = scatter(trial[column])
    unit = unit_off_by(column, claim / found) if found > 0 else None
    if unit is None or (column == _BASE and unit.factor < 1):
        return None
    usual = float(np.median([_swing(other, column) for other in others]))
    times = usual / max(_swing(trial, column), 1e-300)
    return unit if 1 / OTHER_UNIT_SWING < times / unit.factor < OTHER_UNIT_SWING else None


def _swing(trial: Trial, column: str) -> float:
    """Range of a column over that of the base; of the base, its own."""
    own, base = (float(np.nanmax(trial[name]) - np.nanmin(trial[name])) for name in (column, _BASE))
    return own if column == _BASE else own / max(base, 1e-300)
