"""Counts that the encoder of the base has lost, beside an explanation: which jumps, and by how much.

Each jump of the reading (prepare.motion.base_jumps) is shifted back in the motion that drives the
needle, and the trial is replayed: that changes the residual r by d. The explanation has taken up a part
of what was lost, so that its parameters, of slopes J, answer. Of all jumps the one is taken that removes
most,

    gain = (d' r)^2 / d' d,    d and r without what J and jumps that were taken explain,

and so on, while the gain is beyond chance. Their sizes follow from J and all d at once.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from diagnosis.criteria.faults import LOST_COUNTS_GAIN
from diagnosis.fitting.fit import Fit
from diagnosis.fitting.problem import FitProblem
from diagnosis.prepare.motion.base_jumps import Jump
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.workers import Failure, Task, Workers

Array = NDArray[np.float64]

STAGE = "lost counts"
_SIZES = (0.5, 2.0)  # of a jump, in the one that was read amid noise


@dataclass(frozen=True, kw_only=True, eq=False)
class ShiftedBack:
    """What a jump does to the readings beside an explanation.

    Attributes:
      change: of residuals by trial, if the shaft did not make it, (N,) each.
    """

    jump: Jump
    change: tuple[Array, ...]


def shifted_back(
    problem: FitProblem, fit: Fit, jumps: Sequence[Jump], workers: Workers
) -> list[ShiftedBack]:
    """What each jump does, where it can be simulated.

    Args:
      fit: of the explanation to the problem.
      jumps: of the log's base.
    """
    rig = fit.parameterization.rig(fit.x)
    numbers = list(dict.fromkeys(jump.number for jump in jumps))
    runs = [*((number, None) for number in numbers), *((jump.number, jump) for jump in jumps)]
    tasks = [Task(effects=fit.names, arguments=(problem, rig, *run)) for run in runs]
    each = workers.each(STAGE, _residual, tasks)
    as_read = dict(zip(numbers, each, strict=False))
    return [
        ShiftedBack(jump=jump, change=_of_one(fit, jump.number, run - before))
        for jump, run in zip(jumps, each[len(numbers) :], strict=True)
        if not isinstance(run, Failure) and not isinstance(before := as_read[jump.number], Failure)
    ]


def jumps_beside(fit: Fit, each: Sequence[ShiftedBack]) -> tuple[list[Jump], float]:
    """Jumps that the shaft did not make, with their sizes, and the cost that shifting back takes off.

    Args:
      fit: of the explanation.
      each: in the units of its residuals.
    """
    prior = np.zeros(fit.x.size)
    told = [(own.jump, np.concatenate([*own.change, prior])) for own in each]
    taken = list[tuple[Jump, Array]]()
    while told:
        gains = _gains(fit, [d for _, d in taken], [d for _, d in told])
        best = int(np.argmax(gains))
        if gains[best] < LOST_COUNTS_GAIN:
            break
        taken.append(told.pop(best))
    return _sized(fit, taken)


def _residual(problem: FitProblem, rig: RigParameters, number: int, jump: Jump | None) -> Array:
    """Residual of a trial, without a jump of its base if there is one.

    Raises:
      SimulationFailed: the rig cannot be simulated.
    """
    trial = problem.log.trials[number]
    off = jump.size_deg * (trial.time_s >= jump.at_s) if jump else 0.0
    moved = replace(trial, base_motion_deg=trial.base_motion_deg - off)
    usual = problem.resolution.nearer_the_usual  # most of the error of both runs cancels
    alone = replace(problem, log=replace(problem.log, trials=(moved,)), resolution=usual)
    ((found,),) = alone.residuals([rig], callback_alone=True)
    return np.asarray(found)


def _of_one(fit: Fit, number: int, change: Array) -> tuple[Array, ...]:
    """Changes of all residuals by that of one trial."""
    return tuple(change if i == number else np.zeros_like(own) for i, own in enumerate(fit.by_trial))


def _gains(fit: Fit, taken: Sequence[Array], others: Sequence[Array]) -> Array:
    """Cost that each of the others takes off beside what was taken, (n,)."""
    basis, _ = np.linalg.qr(np.column_stack([fit.slopes, *taken]))
    columns = np.column_stack(others)
    beyond = columns - basis @ (basis.T @ columns)
    left = fit.residual - basis @ (basis.T @ fit.residual)
    squares = np.einsum("ij,ij->j", beyond, beyond)
    return np.asarray((left @ beyond) ** 2 / np.maximum(squares, 1e-12))


def _sized(fit: Fit, taken: Sequence[tuple[Jump, Array]]) -> tuple[list[Jump], float]:
    """The jumps with the sizes that remove most together, if near those read; and what they take off."""
    columns = np.column_stack([fit.slopes, *(d for _, d in taken)])
    step = -np.linalg.lstsq(columns, fit.residual, rcond=None)[0]
    sizes = step[fit.x.size :]
    near = [_SIZES[0] < size < _SIZES[1] for size in sizes]
    if not all(near):
        return _sized(fit, [one for one, kept in zip(taken, near, strict=True) if kept])
    left = fit.residual + columns @ step
    sized = [jump.times(float(size)) for (jump, _), size in zip(taken, sizes, strict=True)]
    return sized, float(fit.residual @ fit.residual - left @ left) if taken else 0.0
