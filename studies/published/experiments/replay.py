"""What candidates for the published rig give for published figures.

Each experiment is run on the MuJoCo needle and read off as the paper reads it. Needles
of one schedule and layout run side by side, and no needle is run twice.
"""

from collections import Counter
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from sim.simulation import simulate
from studies.published.experiments.figures import Experiment, Figure
from studies.published.experiments.rig import STATED, PaperRig
from studies.published.experiments.schedules import (
    ELEMENTS,
    SLOW_STEP_S,
    STEP_S,
    Readings,
    read_off,
    schedule,
)

Array = NDArray[np.float64]


class Replay:
    """Predictions of figures, which remembers every needle that it has run.

    Args:
      elements: along the inserted shaft.
      refined: by how much every step is finer than usual.
    """

    def __init__(self, *, elements: int = ELEMENTS, refined: float = 1.0) -> None:
        self._unconverged: Counter[PaperRig] = Counter()
        self._elements, self._refined = elements, refined
        self._known: dict[tuple[Experiment, float, PaperRig], Readings] = {}

    def __call__(self, figures: Sequence[Figure], rigs: Sequence[PaperRig]) -> Array:
        """Every figure by every rig, in the figure's unit, (figures, rigs).

        Raises:
          SimulationFailed: a rig cannot be simulated.
        """
        rows: dict[tuple[Experiment, float], list[Readings]] = {}
        for experiment, depth in dict.fromkeys((f.experiment, f.depth_mm) for f in figures):
            shown = [_shown(experiment, rig) for rig in rigs]
            self._run(experiment, depth, shown)
            rows[experiment, depth] = [self._known[experiment, depth, rig] for rig in shown]
        return np.array(
            [[reading[f.measure] for reading in rows[f.experiment, f.depth_mm]] for f in figures]
        )

    def unconverged(self, rig: PaperRig) -> int:
        """Stages of a rig's runs whose iteration did not converge."""
        return sum(self._unconverged[shown] for shown in {_shown(e, rig) for e in Experiment})

    def _run(self, experiment: Experiment, depth_mm: float, rigs: Sequence[PaperRig]) -> None:
        together: dict[object, list[PaperRig]] = {}
        for rig in dict.fromkeys(rigs):
            if (experiment, depth_mm, rig) not in self._known:
                # A sheath that rubs needs a mesh of its own.
                together.setdefault((rig.free_mm, rig.motion, rig.model.sheath > 0), []).append(rig)
        step = STEP_S.get(experiment, SLOW_STEP_S) / self._refined
        for group in together.values():
            inputs = schedule(experiment, depth_mm, group[0])
            setups = [
                rig.model.setup(STATED, inputs, elements=self._elements, step_s=step) for rig in group
            ]
            for rig, run in zip(group, simulate(setups, inputs), strict=True):
                self._known[experiment, depth_mm, rig] = read_off(experiment, run, rig)
                self._unconverged[rig] += run.unconverged


def _shown(experiment: Experiment, rig: PaperRig) -> PaperRig:
    """The rig, without what an experiment cannot show."""
    if experiment is Experiment.QUICK_TURN:
        return rig
    return replace(rig, free_mm=PaperRig().free_mm, motion=PaperRig().motion)
