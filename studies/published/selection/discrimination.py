"""Beyond the tables: what the text says, and what would tell the survivors apart.

The text puts two numbers on plastisol in words ("about", "nearly"). They are no part of
a fit: predictions are held to them afterwards. The same needles then say which simple
experiment would separate the hypotheses that the tables leave alike.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from studies.published.experiments.figures import Experiment, Figure, Measure
from studies.published.experiments.replay import Replay
from studies.published.fitting.fit import Fit

_APART = 3.0  # spreads
_WORDS = "as the words say"
_SENSOR = "of a sensor like the paper's"


def _figure(
    source: str,
    experiment: Experiment,
    measure: Measure,
    depth_mm: float,
    value: float,
    unit: str,
    spread: float,
    why: str,
) -> Figure:
    return Figure(
        source=source,
        experiment=experiment,
        measure=measure,
        depth_mm=depth_mm,
        value=value,
        unit=unit,
        spread=spread,
        why=why,
    )


# "The plastisols have a lag of about 10 deg"; "the settling time of nearly 2 s", where the
# depth is not said: the deepest of Fig. 5 is taken.
IN_WORDS = (
    _figure("Fig. 3", Experiment.SLOW_TURN, Measure.LAG, 100, 10.0, "deg", 1.5, _WORDS),
    _figure("Fig. 5", Experiment.QUICK_TURN, Measure.SETTLING, 200, 2.0, "s", 0.3, _WORDS),
)
IN_WORDS_OF_GELATIN = (
    _figure("Fig. 3", Experiment.RELEASE, Measure.LAG_LEFT, 100, 0.0, "-", 0.15, _WORDS),
)
"""'Allows the needle to snap near to the final base angle': little of the lag is left."""
FURTHER = (
    _figure("next", Experiment.HELD_TURN, Measure.HELD_TORQUE, 100, 0, "N mm", 0.01, _SENSOR),
    _figure("next", Experiment.BRISK_TURN, Measure.DAMPING, 100, 0, "N mm s", 0.05, _SENSOR),
    _figure("next", Experiment.RELEASE, Measure.LAG_LEFT, 100, 0, "-", 0.1, _SENSOR),
    _figure("next", Experiment.QUICK_TURN, Measure.SETTLING, 200, 0, "s", 0.1, _SENSOR),
    _figure("next", Experiment.QUICK_TURN, Measure.INTEGRAL, 200, 0, "s deg", 3.0, _SENSOR),
)


@dataclass(frozen=True, kw_only=True)
class Prospect:
    """What an experiment would show under each hypothesis.

    Attributes:
      predicted: one a fit, in the figure's unit.
      apart: share of the pairs of hypotheses that it tells apart.
    """

    figure: Figure
    predicted: tuple[float, ...]
    apart: float


def prospects(fits: Sequence[Fit], replay: Replay) -> list[Prospect]:
    """Further experiments, the one that tells most hypotheses apart first."""
    predicted = replay(FURTHER, [f.hypothesis.rig(f.x) for f in fits])
    found = [
        Prospect(figure=figure, predicted=tuple(map(float, row)), apart=_apart(row, figure.spread))
        for figure, row in zip(FURTHER, predicted, strict=True)
    ]
    return sorted(found, key=lambda p: -p.apart)


def _apart(values: NDArray[np.float64], spread: float) -> float:
    told = [abs(a - b) > _APART * spread for a, b in combinations(values, 2)]
    return float(np.mean(told)) if told else 0.0
