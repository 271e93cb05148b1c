"""The ranges of variables that a log covers, and the size of the residual, which scale free laws."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from diagnosis.effects.effect import Effect, Parameter
from diagnosis.fitting.problem import FitProblem
from diagnosis.freeform.smooth_curve import SmoothCurve
from diagnosis.log.trial import SENSORS
from diagnosis.prepare.prepared_log import PreparedTrial
from diagnosis.replay.prediction import Prediction
from diagnosis.replay.sensing.variable_values import of_inputs, of_needle, rate_of
from diagnosis.replay.variables import OF_THE_NEEDLE, Variable
from models import units

Array = NDArray[np.float64]

_OF_READINGS = (Variable.PAST, Variable.TURNED_BY, Variable.LAG, Variable.HELD_BY)
_OF_TRIALS = (Variable.TRIAL_SHARE, Variable.ADVANCED_BY)
LEAST_PAST_S, LONGEST_PAST_S = 0.02, 60.0
_ALL_BUT = 0.002  # of the samples at either end lie beyond a range
LONGER = 1.1  # the longest trial, of the shortest, for shares of trials to be other than their times
LEAST_RANGE = {
    Variable.TIME: 1.0,
    Variable.TRIAL_SHARE: 0.5,
    Variable.BASE_ANGLE: 20.0,
    Variable.RATE: 0.05,
    Variable.ACCELERATION: 0.5,
    Variable.DIRECTION: 1.5,
    Variable.SLID_DIRECTION: 1.5,
    Variable.AXIAL_SPEED: 0.3,
    Variable.SLID_LATELY: 0.2,
    Variable.PUSHED_LATELY: 0.2,
    Variable.RESTED: 1.0,
    Variable.AXIAL_DRAG: 5.0,
    Variable.AXIAL_FLOW: 20.0,
    Variable.THRUST: 10.0,
    Variable.DEPTH: 5.0,
    Variable.FREE: 5.0,
    Variable.ADVANCED_BY: 2.0,
    Variable.SLID: 5.0,
    Variable.TRAVELLED: 5.0,
    Variable.HISTORY: 0.1,
    Variable.TIP_ANGLE: 20.0,
    Variable.TIP_RATE: 0.05,
    Variable.TIP_DIRECTION: 1.5,
    Variable.TORQUE: 0.0,
    Variable.TORQUE_RATE: 0.0,
    Variable.PAST: 0.0,
    Variable.TURNED_BY: 0.0,
    Variable.LAG: 0.0,
    Variable.HELD_BY: 0.0,
}
"""Below which nothing can depend on a variable visibly."""


@dataclass(frozen=True, kw_only=True, eq=False)
class LogRanges:
    """The ranges that a log covers, and its nominal residual.

    Attributes:
      ends: lowest and highest value of each variable that varies enough.
      missing: rms of the nominal residual by measured sensor, in the unit of its name.
      nominal: readings of the nominal rig by trial.
      left: residual of the nominal rig by sensor and trial, in the unit of its name; NaN: no reading.
      softer: readings of a rig with a little less damping by trial; none: not simulated.
      detail: how often the places of curves of free-form laws are halved.
    """

    problem: FitProblem
    nominal: Sequence[Prediction]
    ends: Mapping[Variable, tuple[float, float]]
    missing: Mapping[str, float]
    left: Mapping[str, tuple[Array, ...]]
    softer: Sequence[Prediction] = ()
    detail: int = 0

    @property
    def in_more_detail(self) -> "LogRanges":
        """The same with places of curves twice as close."""
        return replace(self, detail=self.detail + 1)

    def in_detail(self, curve: SmoothCurve) -> SmoothCurve:
        """The curve of a law: finer, if laws of these ranges have more detail than usual."""
        for _ in range(self.detail):
            curve = curve.finer
        return curve

    @property
    def library(self) -> Mapping[str, Effect]:
        """Effects with bounds and starts for a rig of this size."""
        return self.problem.library

    @property
    def dry_level(self) -> Parameter:
        """The level of dry friction along the shaft, with its bounds and starts."""
        return self.library["coulomb_friction"].parameters[0]

    @property
    def damping_n_mm_s_per_mm(self) -> float:
        """Nominal damping."""
        return float(self.problem.log.rig.tissue.damping_n_mm_s_per_mm)

    @property
    def longest_mm(self) -> float:
        """Length of the shaft from chuck to tip, at most."""
        trials = self.problem.log.trials
        return max(float((trial.free_mm + trial.inserted_mm).max()) for trial in trials)

    @property
    def deepest_mm(self) -> float:
        """Inserted length, at most."""
        return max(float(trial.schedule.inserted_mm.max()) for trial in self.problem.log.trials)

    @property
    def deg_per_n_mm(self) -> float:
        """Twist of the longest nominal shaft over the torque that it asks for."""
        return self.longest_mm / self.problem.log.rig.rigidity_n_mm2 / units.DEG

    @property
    def fastest_slip_rad_s(self) -> float:
        """Fastest turn of the nominal shaft within the tissue, which is at its entry.

        The angle there is that of the base less torque * free length / rigidity.
        """
        log, fastest = self.problem.log, 0.0
        for trial, own in zip(log.trials, self.nominal, strict=True):
            base = np.radians(np.interp(trial.time_s, trial.schedule.time_s, trial.schedule.drive))
            entry = base - own.base_torque_n_mm * trial.free_mm / log.rig.rigidity_n_mm2
            fastest = max(fastest, float(np.max(np.abs(rate_of(entry, trial.time_s)))))
        return fastest


def ranges_of(
    problem: FitProblem, nominal: Sequence[Prediction], softer: Sequence[Prediction] = ()
) -> LogRanges:
    """Ranges of a log, given readings of the nominal rig, and of one with less damping, by trial."""
    trials = problem.log.trials
    moving = (v for v in Variable if v not in (*_OF_READINGS, *_OF_TRIALS))
    found: dict[Variable, tuple[float, float]] = {v: _ends(v, trials, nominal) for v in moving}
    found[Variable.PAST] = (LEAST_PAST_S, LONGEST_PAST_S)
    found[Variable.TURNED_BY] = (0.0, 1.0)
    found[Variable.ADVANCED_BY] = (0.0, max(float(np.ptp(trial.inserted_mm)) for trial in trials))
    found[Variable.TRIAL_SHARE] = (0.0, float(_last_differently(trials)))
    left = {
        sensor: tuple(
            trial.readings[sensor] - own[sensor]
            for trial, own in zip(trials, nominal, strict=True)
            if trial.has(sensor)
        )
        for sensor in SENSORS
    }
    read = {sensor: each for sensor, each in left.items() if each}
    return LogRanges(
        problem=problem,
        nominal=nominal,
        ends={v: e for v, e in found.items() if e[1] - e[0] > LEAST_RANGE[v]},
        missing={s: float(np.sqrt(np.nanmean(np.concatenate(each) ** 2))) for s, each in read.items()},
        left=read,
        softer=softer,
    )


def _last_differently(trials: Sequence[PreparedTrial]) -> bool:
    """Whether some trials are clearly longer than others: else a share of a trial is its time."""
    lasting = [float(trial.time_s[-1] - trial.time_s[0]) for trial in trials]
    return max(lasting) > LONGER * min(lasting)


def _ends(
    variable: Variable, trials: Sequence[PreparedTrial], nominal: Sequence[Prediction]
) -> tuple[float, float]:
    values = np.concatenate(
        [values_of(variable, trial, own) for trial, own in zip(trials, nominal, strict=True)]
    )
    low, high = np.quantile(values, [_ALL_BUT, 1 - _ALL_BUT])
    return float(low), float(high)


def values_of(variable: Variable, trial: PreparedTrial, nominal: Prediction) -> Array:
    """A variable at the times of the nominal schedule, or of the trial's samples if of the needle."""
    if variable not in OF_THE_NEEDLE:
        return of_inputs(variable, trial.schedule, float(trial.time_s[0]))
    return of_needle(variable, trial.time_s, nominal.tip_angle_deg, nominal.base_torque_n_mm)
