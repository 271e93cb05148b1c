"""By how much costs may differ for what no model of a needle resolves.

The readings of a good torque sensor are thousands of times their noise. Neither a replay nor a rig is
exact to a ten-thousandth, and an effect that is not there may take up what is left of that:

    cost = samples (share rms(reading) / sigma)^2,

where the reading of the tip is its lag behind the base. With readings of some hundred sigma that is
less than the odds that are asked for anyway. And laws of effects are no better known than some
thousandths of what they change, as where dry friction begins to slide:

    cost = (share of the law)^2 sum((change of the readings / sigma)^2).
"""

import numpy as np
from numpy.typing import NDArray

from diagnosis.criteria.selection import CONTENDING, LAW_UNRESOLVED_SHARE, UNRESOLVED_SHARE
from diagnosis.fitting.fit import Fit, change_without
from diagnosis.fitting.problem import FitProblem
from diagnosis.log.trial import SENSORS, TIP
from diagnosis.prepare.prepared_log import PreparedTrial

Array = NDArray[np.float64]


def unresolved_cost(problem: FitProblem) -> float:
    """Of two explanations of a log."""
    each = (
        np.sum((_signal(trial, sensor) / problem.noise[sensor]) ** 2)
        for trial in problem.log.trials
        for sensor in SENSORS
        if trial.has(sensor)
    )
    return float(UNRESOLVED_SHARE**2 * sum(each))


def unresolved_law_cost(problem: FitProblem, fit: Fit) -> float:
    """Of an explanation and another one that builds on it.

    Raises:
      SimulationFailed: the rig without the effects of the fit cannot be simulated.
    """
    return LAW_UNRESOLVED_SHARE**2 * change_without(problem, fit, fit.names)


def contending(problem: FitProblem) -> float:
    """Score behind the best beyond which an explanation is out of the question."""
    return CONTENDING + unresolved_cost(problem)


def _signal(trial: PreparedTrial, sensor: str) -> Array:
    """Readings of a torque, or by how far the tip lags, (n,)."""
    read = trial.readings[sensor]
    signal = trial.base_motion_deg - read if sensor == TIP else read
    return np.asarray(signal[np.isfinite(read)])
