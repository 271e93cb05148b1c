"""Which simple experiment would separate the hypotheses that the tables leave equivalent."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from studies.published import criteria
from studies.published.experiments.measurement import Quantity, TurnExperiment, TurnMeasurement
from studies.published.experiments.replay import FigureReplay
from studies.published.fitting.fit import FigureFit

PROPOSED = (
    TurnMeasurement(
        experiment=TurnExperiment.HELD_TURN,
        quantity=Quantity.HELD_TORQUE,
        depth_mm=100,
        unit="N mm",
        sigma=criteria.PROPOSED_HELD_TORQUE_SIGMA_N_MM,
    ),
    TurnMeasurement(
        experiment=TurnExperiment.BRISK_TURN,
        quantity=Quantity.DAMPING,
        depth_mm=100,
        unit="N mm s",
        sigma=criteria.PROPOSED_DAMPING_SIGMA_N_MM_S,
    ),
    TurnMeasurement(
        experiment=TurnExperiment.RELEASE,
        quantity=Quantity.LAG_LEFT,
        depth_mm=100,
        unit="-",
        sigma=criteria.PROPOSED_LAG_LEFT_SIGMA,
    ),
    TurnMeasurement(
        experiment=TurnExperiment.QUICK_TURN,
        quantity=Quantity.SETTLING,
        depth_mm=200,
        unit="s",
        sigma=criteria.PROPOSED_SETTLING_SIGMA_S,
    ),
    TurnMeasurement(
        experiment=TurnExperiment.QUICK_TURN,
        quantity=Quantity.INTEGRAL,
        depth_mm=200,
        unit="s deg",
        sigma=criteria.PROPOSED_INTEGRAL_SIGMA_DEG_S,
    ),
)


@dataclass(frozen=True, kw_only=True)
class ProposedExperiment:
    """Predictions of an experiment under each hypothesis.

    Attributes:
      predicted: one value per fit, in the measurement's unit.
      separated: share of the pairs of hypotheses that the experiment separates.
    """

    measurement: TurnMeasurement
    predicted: tuple[float, ...]
    separated: float


def proposed_experiments(fits: Sequence[FigureFit], replay: FigureReplay) -> list[ProposedExperiment]:
    """Experiments that the paper did not do, in the order of how many hypotheses they separate."""
    predicted = replay(PROPOSED, [f.hypothesis.rig(f.x) for f in fits])
    found = [
        ProposedExperiment(
            measurement=measurement,
            predicted=tuple(map(float, row)),
            separated=_separated(row, measurement.sigma),
        )
        for measurement, row in zip(PROPOSED, predicted, strict=True)
    ]
    return sorted(found, key=lambda p: -p.separated)


def _separated(values: NDArray[np.float64], sigma: float) -> float:
    pairs = [abs(a - b) > criteria.SEPARATED_SIGMAS * sigma for a, b in combinations(values, 2)]
    return float(np.mean(pairs)) if pairs else 0.0
