"""Number of ripples of a reading per turn: cogging of a drive, teeth of a gear, an encoder's disc.

A ripple of n waves reduces the sum of squares of the nominal residual by |sum residual exp(i n angle)|^2
/ N, twice that for real waves; the n with the largest reduction is chosen.
"""

import numpy as np
from numpy.typing import NDArray

from diagnosis.freeform.ranges import LogRanges, values_of
from diagnosis.prepare.prepared_log import PreparedTrial
from diagnosis.replay.prediction import Prediction
from diagnosis.replay.variables import OF_THE_NEEDLE, Variable

Array = NDArray[np.float64]

MOST_WAVES = 60


def waves_in_a_turn(ranges: LogRanges, sensor: str, variable: Variable) -> int:
    """Waves per turn of an angle that reduce the nominal residual most; at least two."""
    every = zip(ranges.problem.log.trials, ranges.nominal, strict=True)
    read = [(trial, nominal) for trial, nominal in every if trial.has(sensor)]
    taken = np.zeros(MOST_WAVES + 1)
    for (trial, nominal), left in zip(read, ranges.left[sensor], strict=True):
        finite = np.isfinite(left)
        own = left[finite] - left[finite].mean()
        angles = np.radians(_at_samples(variable, trial, nominal)[finite])
        for waves in range(2, MOST_WAVES + 1):
            taken[waves] += abs(np.vdot(own, np.exp(1j * waves * angles))) ** 2 / own.size
    return 2 + int(np.argmax(taken[2:]))


def _at_samples(variable: Variable, trial: PreparedTrial, nominal: Prediction) -> Array:
    values = values_of(variable, trial, nominal)
    if variable in OF_THE_NEEDLE:
        return values
    return np.interp(trial.time_s, trial.schedule.time_s, values)
