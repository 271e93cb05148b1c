"""Replaying a log: what the sensors of the nominal needle would have read.

The simulated needle is driven by the measured base angle, depth, free length and
speed of each trial. The slip of the tissue is taken at a fixed place, as in the
paper's equation (9), on whose model the nominal rig rests.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from diagnosis.evidence import FINE
from diagnosis.rig_log import SENSORS, Rig, RigLog, Trial
from diagnosis.rig_model import RigModel
from sim.simulation import Run, simulate

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class Replay:
    """A trial beside its prediction.

    Attributes:
      trial: what was measured.
      predicted: by sensor, at the samples of the trial, (N,).
      run: the whole simulated run, on its own steps, with the shape of the shaft.
    """

    trial: Trial
    predicted: dict[str, Array]
    run: Run

    def residual(self, sensor: str) -> Array:
        """Measured less predicted, (N,)."""
        return self.trial[sensor] - self.predicted[sensor]


def replay(log: RigLog) -> list[Replay]:
    """Every trial, on the nominal needle."""
    return [_replay(log.rig, trial) for trial in log.trials]


def _replay(rig: Rig, trial: Trial) -> Replay:
    schedule = trial.schedule()
    step = FINE.step_of(trial)
    setup = RigModel().setup(rig, schedule, elements=FINE.elements, step_s=step)
    run = simulate([setup], schedule, keep_shape=True)[0]
    simulated = {"base_torque_n_mm": run.base_torque_n_mm, "tip_angle_deg": run.tip_deg}
    predicted = {name: np.interp(trial["time_s"], run.time_s, simulated[name]) for name in SENSORS}
    return Replay(trial=trial, predicted=predicted, run=run)
