"""What the noise of the base's encoder makes of residuals.

Beside a stiff or sticking element near the base it comes back as torque, and slowly so; and so does what
smoothing rounds off the motion. Readings of an encoder with that noise are drawn anew, and the rig of a
candidate is simulated with each.
"""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from diagnosis.criteria.fitting import BASE_NOISE_GAP, BASE_NOISE_MORE, BASE_NOISE_READINGS
from diagnosis.fitting.held_out.cross_validation import shift_statistic
from diagnosis.fitting.noise_floor import NoiseFloor, floor_of
from diagnosis.fitting.problem import FitProblem
from diagnosis.selection.candidate import Candidate

Array = NDArray[np.float64]

_SEED = 21


def allowing_base_noise(one: Candidate, problem: FitProblem) -> Candidate:
    """The same with limits that know what the noise of the encoder leaves in the base motion.

    Of some readings of the encoder the worst counts.

    Raises:
      SimulationFailed: the rig cannot be simulated with another reading.
    """
    shifts = one.shift > one.shift_limit
    if (one.floor.reached and not shifts) or one.floor.gap > BASE_NOISE_GAP:
        return one
    floor, shift_limit, worst = one.floor, one.shift_limit, NoiseFloor(gap=0.0, slow=0.0)
    for own in _changes(one, problem):
        left = floor_of(own)
        worst = NoiseFloor(gap=max(worst.gap, left.gap), slow=max(worst.slow, left.slow))
        floor = one.floor.allowing(worst)
        shift = shift_statistic(replace(one.fit, by_trial=own))
        shift_limit = max(shift_limit, one.shift_limit + shift)
        if not one.floor.allowing(worst.times(BASE_NOISE_MORE)).reached:
            break  # none of the others changes so much more
    return replace(one, floor=floor, shift_limit=shift_limit)


def with_base_noise_cost(one: Candidate, problem: FitProblem) -> Candidate:
    """The same with the cost that the noise of the encoder makes, where only a delay is missing.

    A filter in place of the delay takes it away. Residuals differ by the noise of two readings.

    Raises:
      SimulationFailed: as `allowing_base_noise`.
    """
    if not (one.floor.reached and one.only_late):
        return one
    changes = _changes(one, problem)
    return replace(one, base_noise_cost=max(_squares(own) for own in changes) / 2)


def _changes(one: Candidate, problem: FitProblem) -> Iterator[tuple[Array, ...]]:
    """By how much residuals of each trial change from reading to reading of the encoder."""
    rig, rng = one.fit.parameterization.rig(one.fit.x), np.random.default_rng(_SEED)
    sharp = problem.sharpened()
    true = sharp.residuals([rig], callback_alone=True)
    for _ in range(BASE_NOISE_READINGS):
        runs = sharp.read_again(rng).residuals([rig], callback_alone=True)
        yield tuple(run[0] - left[0] for run, left in zip(runs, true, strict=True))


def _squares(by_trial: tuple[Array, ...]) -> float:
    return sum(float(own @ own) for own in by_trial)
