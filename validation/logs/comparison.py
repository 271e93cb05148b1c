"""Comparison of rigs on the trials of one log, in units of the noise of its sensors."""

import json
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from validation.logs.sensors import TIP, TORQUE, LogSensors
from validation.rig.motion import TrialMotion
from validation.rig.rig import IndependentRig
from validation.rig.simulation import COARSE, FINE, CellCounts, ideal_signals
from validation.rig.unmodelled.effect import IdealSignals

Array = NDArray[np.float64]
COARSE_STEP_S = 0.01


class RigComparison:
    """Signals of rigs on the same trials; every rig is simulated once.

    A coarse comparison, with long steps and few cells, is ten times faster, with an error of a few
    percent of an effect. It serves searches; the final values come from a fine one.
    """

    def __init__(self, motions: list[TrialMotion], sensors: LogSensors, *, coarse: bool = False) -> None:
        self.motions = [_decimated(motion) for motion in motions] if coarse else motions
        self.sensors = sensors
        self._cells: CellCounts = COARSE if coarse else FINE
        self._known: dict[str, list[IdealSignals]] = {}

    def signals(
        self, rig: IndependentRig, driven_as: list[IdealSignals] | None = None
    ) -> list[IdealSignals]:
        """Ideal signals of every trial; `driven_as`: signals whose base angles drive it instead."""
        key = json.dumps([rig.effects, rig.outside], sort_keys=True)
        if driven_as is not None:
            scale = rig.sensor("base_angle_scale", "scale")
            base = [signals.base_deg / scale for signals in driven_as]
            if any(np.any(b != m.base_deg) for b, m in zip(base, self.motions, strict=True)):
                motions = [replace(m, base_deg=b) for m, b in zip(self.motions, base, strict=True)]
                return [ideal_signals(rig, motion, self._cells) for motion in motions]
        if key not in self._known:
            self._known[key] = [ideal_signals(rig, motion, self._cells) for motion in self.motions]
        return self._known[key]

    def difference(self, rig: IndependentRig, other: IndependentRig) -> Array:
        """Signals of `rig` minus those of `other`, which is driven by the base angle that `rig` shows.

        Returns:
          In units of sigma, the noise of each sensor; all samples of all trials and signals, (N,).
        """
        own = self.signals(rig)
        return self._normalised(own) - self._normalised(self.signals(other, own))

    def signature(self, rig: IndependentRig, other: IndependentRig) -> float:
        """Root mean square of the difference / sigma."""
        return rms(self.difference(rig, other))

    def _normalised(self, all_signals: list[IdealSignals]) -> Array:
        parts = []
        for motion, signals in zip(self.motions, all_signals, strict=True):
            values = {TIP: signals.tip_deg, TORQUE: signals.torque_n_mm}
            for signal in self.sensors.shown:
                parts.append(values[signal][motion.recorded] / self.sensors.noise[signal])
        return np.concatenate(parts)


def rms(values: Array) -> float:
    """Root mean square."""
    return float(np.sqrt(np.mean(values**2)))


def _decimated(motion: TrialMotion) -> TrialMotion:
    """The same motion on a coarse time grid; all its points count as samples."""
    every = max(round(COARSE_STEP_S / motion.dt_s), 1)
    tip_torque = motion.tip_torque_n_mm
    return TrialMotion(
        dt_s=motion.dt_s * every,
        per_sample=1,
        trial=motion.trial,
        lead=motion.lead // every,
        base_deg=motion.base_deg[::every],
        inserted_mm=motion.inserted_mm[::every],
        free_mm=motion.free_mm[::every],
        speed_mm_s=motion.speed_mm_s[::every],
        tip_torque_n_mm=None if tip_torque is None else tip_torque[::every],
    )
