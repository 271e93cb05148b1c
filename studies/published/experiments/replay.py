"""The published experiments, simulated with possible forms of the published rig.

Needles with the same schedule and memory map are simulated together, and none twice.
"""

from collections import Counter
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from sim.simulation import simulate
from studies.published.criteria import ELEMENTS
from studies.published.experiments.measurement import TurnExperiment, TurnMeasurement
from studies.published.experiments.read_off import Quantities, read_off
from studies.published.experiments.rig import STATED, WITH_FREE_LENGTH, PublishedRig
from studies.published.experiments.schedules import schedule, step_s

Array = NDArray[np.float64]


class FigureReplay:
    """Predicts measurements; results of simulations are cached.

    Args:
      elements: number of elements along the inserted shaft.
      refinement: factor by which every time step is divided.
    """

    def __init__(self, *, elements: int = ELEMENTS, refinement: float = 1.0) -> None:
        self._unconverged: Counter[PublishedRig] = Counter()
        self._elements, self._refinement = elements, refinement
        self._known: dict[tuple[TurnExperiment, float, PublishedRig], Quantities] = {}

    def __call__(self, measurements: Sequence[TurnMeasurement], rigs: Sequence[PublishedRig]) -> Array:
        """Predictions by all rigs, in the measurements' units, (measurements, rigs).

        Raises:
          SimulationFailed: a rig cannot be simulated.
        """
        rows: dict[tuple[TurnExperiment, float], list[Quantities]] = {}
        for experiment, depth in dict.fromkeys((m.experiment, m.depth_mm) for m in measurements):
            seen = [_as_seen_by(experiment, rig) for rig in rigs]
            self._run(experiment, depth, seen)
            rows[experiment, depth] = [self._known[experiment, depth, rig] for rig in seen]
        return np.array(
            [[values[m.quantity] for values in rows[m.experiment, m.depth_mm]] for m in measurements]
        )

    def unconverged(self, rig: PublishedRig) -> int:
        """Number of stages in a rig's simulations whose iteration did not converge."""
        return sum(self._unconverged[seen] for seen in {_as_seen_by(e, rig) for e in TurnExperiment})

    def _run(self, experiment: TurnExperiment, depth_mm: float, rigs: Sequence[PublishedRig]) -> None:
        together: dict[object, list[PublishedRig]] = {}
        for rig in dict.fromkeys(rigs):
            if (experiment, depth_mm, rig) not in self._known:
                # Friction in the sheath needs a mesh of its own.
                together.setdefault(
                    (rig.free_mm, rig.turn, rig.model.sheath_friction_n_mm_per_mm > 0), []
                ).append(rig)
        step = step_s(experiment) / self._refinement
        for group in together.values():
            inputs = schedule(experiment, depth_mm, group[0])
            setups = [
                rig.model.setup(STATED, inputs, elements=self._elements, step_s=step) for rig in group
            ]
            for rig, run in zip(group, simulate(setups, inputs), strict=True):
                self._known[experiment, depth_mm, rig] = read_off(experiment, run, rig)
                self._unconverged[rig] += run.unconverged


def _as_seen_by(experiment: TurnExperiment, rig: PublishedRig) -> PublishedRig:
    """The rig without those changes that have no influence in an experiment."""
    if experiment is TurnExperiment.QUICK_TURN:
        return rig
    return replace(rig, free_mm=WITH_FREE_LENGTH.free_mm, turn=WITH_FREE_LENGTH.turn)
