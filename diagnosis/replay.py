"""Replaying a log: what the sensors of the nominal needle would have read.

The simulated needle is driven by the measured base angle, depth, free length and
speed of each trial. The slip of the tissue is taken at a fixed place, as in the
paper's equation (9), on whose model the nominal rig rests.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from diagnosis.rig_log import SENSORS, Rig, RigLog, Trial
from models.needle import Needle
from models.tissue import Tissue
from sim.discretisation import Discretisation, Mesh, Slip
from sim.schedule import Schedule
from sim.simulation import Run, simulate
from sim.spec import Setup

Array = NDArray[np.float64]

_LARGEST_STEP_S = 0.01


@dataclass(frozen=True, kw_only=True)
class Replay:
    """A trial beside its prediction.

    Attributes:
      trial: what was measured.
      predicted: by sensor, at the samples of the trial, (N,).
      run: the whole simulated run, on its own steps.
    """

    trial: Trial
    predicted: dict[str, Array]
    run: Run

    def residual(self, sensor: str) -> Array:
        """Measured less predicted, (N,)."""
        return self.trial[sensor] - self.predicted[sensor]


def nominal_setup(rig: Rig, trial: Trial) -> Setup:
    """The needle and tissue that `rig.yaml` describes, as a trial starts."""
    schedule = trial.schedule()
    step = min(_LARGEST_STEP_S, float(np.median(np.diff(schedule.time_s))))
    return Setup(
        needle=Needle(**dict(rig.needle), length_mm=max(schedule.longest_mm, 1.0)),
        tissue=Tissue.uniform(viscous_n_mm_s_per_mm=rig.tissue.damping_n_mm_s_per_mm),
        discretisation=Discretisation(step_s=step, slip=Slip.PLACE),
        mesh=schedule.mesh,
        free_mm=float(schedule.free_mm[0]),
        inserted_mm=_modelled_mm(schedule),
    )


def _modelled_mm(schedule: Schedule) -> float:
    """Shaft beyond the entry at the start: what is inserted, and what lies beyond the tissue."""
    if schedule.mesh is Mesh.TISSUE:
        return float(schedule.inserted_mm[0])
    return schedule.longest_mm - float(schedule.free_mm[0])


def replay(log: RigLog) -> list[Replay]:
    """Every trial, on the nominal needle."""
    return [_replay(log.rig, trial) for trial in log.trials]


def _replay(rig: Rig, trial: Trial) -> Replay:
    run = simulate([nominal_setup(rig, trial)], trial.schedule(), keep_shape=True)[0]
    simulated = {"base_torque_n_mm": run.base_torque_n_mm, "tip_angle_deg": run.tip_deg}
    predicted = {name: np.interp(trial["time_s"], run.time_s, simulated[name]) for name in SENSORS}
    return Replay(trial=trial, predicted=predicted, run=run)
