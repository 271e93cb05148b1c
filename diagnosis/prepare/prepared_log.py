"""A log that can be replayed: the motion that drives the needle, and the readings of the sensors.

The encoder's reading (`base_angle_deg` of a logged trial) differs from the estimated motion of the
base (`base_motion_deg` here): a replay is driven by the motion.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.signal import savgol_filter

from diagnosis.criteria.fitting import SLIDING_MM_S
from diagnosis.criteria.prepare import STEADY_DEPTH_MM
from diagnosis.log.nominal_rig import NominalRig
from diagnosis.prepare.motion.between_samples import between_samples
from diagnosis.prepare.motion.inertia import InertiaTorque, inertia_warning, smooth_motion
from diagnosis.prepare.start.late_start import LateStart, late_start_warning
from sim.discretisation import PRESLIDING_DEG
from sim.schedule import Schedule

Array = NDArray[np.float64]
SMOOTH_TORQUE_S = 0.15
_CUBIC = 3
Mask = NDArray[np.bool_]


@dataclass(frozen=True, kw_only=True, eq=False)
class PreparedTrial:
    """A trial to replay; every array has the shape of `time_s`, (N,).

    Attributes:
      name: name of its file.
      base_motion_deg: angle of the drive shaft, without the encoder's noise and across gaps.
      tip_torque_n_mm: known torque at the tip; None: none.
      readings: by sensor, in the unit of its name; NaN where there is none.
      logged: mask of rows that are samples of the log; the others fill its gaps.
      inertia: the share of inertia in its base torque.
      late_start: None: it begins untwisted and at rest.
      after_gaps: mask of rows whose readings are not used because the base's motion in a gap before them
        is uncertain; None: no row.
      weights: by sensor, those of its residuals; 1 for other sensors.
      time_errors_s: what `time_s` may be off by, by example, (K, N); None: they are exact.
      smoothed_above_hz: corner of the filter by which readings were smoothed, by sensor.
    """

    name: str
    time_s: Array
    base_motion_deg: Array
    inserted_mm: Array
    free_mm: Array
    speed_mm_s: Array
    tip_torque_n_mm: Array | None
    readings: Mapping[str, Array]
    logged: Mask
    inertia: InertiaTorque = InertiaTorque()  # noqa: RUF009 - frozen
    late_start: LateStart | None = None
    after_gaps: Mask | None = None
    weights: Mapping[str, Array] = field(default_factory=dict)
    time_errors_s: Array | None = None
    smoothed_above_hz: Mapping[str, float] = field(default_factory=dict)

    def has(self, sensor: str) -> bool:
        """Whether the trial has readings of this sensor."""
        return sensor in self._measured

    def counting_less(self, errors_sigma: Mapping[str, Array]) -> "PreparedTrial":
        """The trial with weights of its readings for errors of their prediction, by sensor, (N,)."""
        weights = {s: self.weights.get(s, 1.0) / np.sqrt(1.0 + e**2) for s, e in errors_sigma.items()}
        return replace(self, weights={**self.weights, **weights})

    # A fit asks thousands of times for the same; nothing of a trial ever changes.
    @cached_property
    def schedule(self) -> Schedule:
        """The inputs of the needle."""
        torque = self.tip_torque_n_mm
        finer = smooth_motion if self.inertia.counts else between_samples
        time, motion = finer(self.time_s, self.base_motion_deg)

        def at(values: Array) -> Array:
            return values if time is self.time_s else np.interp(time, self.time_s, values)

        return Schedule(
            time_s=time,
            drive=motion,
            free_mm=at(self.free_mm),
            inserted_mm=at(_steadied(self.inserted_mm)),
            speed_mm_s=at(self.speed_mm_s),
            tip_torque_n_mm=np.zeros(0) if torque is None else at(np.nan_to_num(torque)),
        )

    @cached_property
    def smooth_torque_n_mm(self) -> Array:
        """Measured base torque without most of its noise, across gaps; 0 if not measured, (N,)."""
        read = np.isfinite(self.readings.get("base_torque_n_mm", np.zeros(0)))
        if not read.any():
            return np.zeros(self.time_s.size)
        torque = np.interp(self.time_s, self.time_s[read], self.readings["base_torque_n_mm"][read])
        # A cubic over 9 / 4 of the time has the noise of a mean, and follows what turns.
        size = 2 * round(9 / 8 * SMOOTH_TORQUE_S / self.sample_s) + 1
        return (
            np.asarray(savgol_filter(torque, size, _CUBIC)) if _CUBIC < size <= torque.size else torque
        )

    @property
    def slides(self) -> bool:
        """Whether the needle moves along its axis."""
        return bool((np.abs(self.speed_mm_s) > SLIDING_MM_S).any())

    @cached_property
    def sample_s(self) -> float:
        """Median time between samples."""
        return float(np.median(np.diff(self.time_s)))

    @cached_property
    def _measured(self) -> frozenset[str]:
        return frozenset(name for name, values in self.readings.items() if np.isfinite(values).any())


DRAGGED = (
    "elastic tissue is taken to go along with the shaft where that slides; if it stays where it is, "
    "nothing explains the log"
)
_SLIDES = "dry friction is taken to give by {:.3g} deg before it slides, not by the usual {:g} deg"


@dataclass(frozen=True, kw_only=True)
class PreparedLog:
    """The nominal rig and its trials, ready for replay.

    Attributes:
      rounded: least noise of columns that are read in coarse steps.
      means_of: number of readings that a sample is the mean of.
      noise_left: noise in the low band of smoothed readings / that of a reading, by sensor.
      tissue_dragged: whether elastic tissue is taken to go along with the shaft where that slides.
      presliding_deg: angle by which dry friction is taken to give before it slides.
    """

    rig: NominalRig
    trials: tuple[PreparedTrial, ...]
    rounded: Mapping[str, float] = field(default_factory=dict)
    means_of: int = 1
    noise_left: Mapping[str, float] = field(default_factory=dict)
    tissue_dragged: bool = False
    presliding_deg: float = PRESLIDING_DEG

    @property
    def warnings(self) -> tuple[str, ...]:
        """Warnings about trials whose sampling rate is too low for inertia, that began late, or whose
        tissue is dragged along, and about dry friction that slides after another angle.
        """
        dragged = DRAGGED if self.tissue_dragged else ""
        usual = self.presliding_deg == PRESLIDING_DEG
        slides = "" if usual else _SLIDES.format(self.presliding_deg, PRESLIDING_DEG)
        each = [inertia_warning(trial.name, trial.inertia) for trial in self.trials]
        late = {trial.name: trial.late_start for trial in self.trials if trial.late_start}
        return tuple(
            warning for warning in (*each, late_start_warning(late), dragged, slides) if warning
        )


def _steadied(depth_mm: Array) -> Array:
    """A depth that hardly changes, made constant: the rest is the noise of the stage's reading."""
    if np.ptp(depth_mm) >= STEADY_DEPTH_MM:
        return depth_mm
    return np.full(depth_mm.shape, np.median(depth_mm))
