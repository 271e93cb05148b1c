"""The error of the replay itself: what halving steps and elements changes, over the noise."""

import numpy as np
from numpy.typing import NDArray

from diagnosis.evidence import Evidence, Resolution
from diagnosis.predict import predict
from diagnosis.rig_log import SENSORS
from diagnosis.rig_model import RigModel

Array = NDArray[np.float64]

# An error of this much of the noise adds 1 % to a gap that is at the noise floor.
LARGEST = 0.14


def replay_change(evidence: Evidence, rig: RigModel) -> list[dict[str, Array]]:
    """What half the step and twice the elements change, over noise, by trial and sensor.

    The method is of second order in the step and of higher order in the elements: the
    error that is left is about a third of the change.
    """
    log, coarser = evidence.log, evidence.resolution
    found = []
    for trial in log.trials:
        finer = Resolution(elements=2 * coarser.elements, step_s=0.5 * coarser.step_of(trial))
        here, there = (predict(log.rig, trial, [rig], r)[0] for r in (coarser, finer))
        change = {s: (there[s] - here[s]) / evidence.noise[s] for s in SENSORS if trial.has(s)}
        found.append({s: c[np.isfinite(trial[s])] for s, c in change.items()})
    return found


def replay_error(change: list[dict[str, Array]]) -> dict[str, float]:
    """Root mean square of the change by sensor."""
    parts = {s: [c[s] for c in change if s in c] for s in SENSORS}
    return {s: float(np.sqrt(np.mean(np.concatenate(p) ** 2))) for s, p in parts.items() if p}


def warnings_of(error: dict[str, float]) -> tuple[str, ...]:
    """A warning for every sensor that the replay is too coarse for."""
    return tuple(
        f"{sensor}: the replay's own error is {value:.2f} of the noise; gaps below "
        f"{np.hypot(1.0, value):.2f} mean little here"
        for sensor, value in error.items()
        if value > LARGEST
    )
