"""Compares rigs on the trials of one log, in units of the noise of its sensors."""

import json
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from validation.rig.unmodelled import Trace
from validation.rig.rig import COARSE, FINE, Fineness, Motion, Rig, observe
from validation.logs.sensors import TIP, TORQUE, Sensors

Array = NDArray[np.float64]
COARSE_STEP_S = 0.01


class Bench:
    """Trials on which rigs are run and remembered.

    A coarse bench, with long steps and few cells, is ten times faster, and good to a few hundredths
    of an effect. It is for searches; what matters is measured on a fine one.
    """

    def __init__(self, motions: list[Motion], sensors: Sensors, *, coarse: bool = False) -> None:
        self.motions = [_thinned(motion) for motion in motions] if coarse else motions
        self.sensors = sensors
        self._fineness: Fineness = COARSE if coarse else FINE
        self._known: dict[str, list[Trace]] = {}

    def show(self, rig: Rig, shown: list[Trace] | None = None) -> list[Trace]:
        """What sensors show, or would, had the drive turned as `shown`. Remembered per rig."""
        key = json.dumps([rig.effects, rig.outside], sort_keys=True)
        if shown is not None:
            turns = [trace.base_deg for trace in shown]
            if any(np.any(t != m.base_deg) for t, m in zip(turns, self.motions, strict=True)):
                motions = [replace(m, base_deg=t) for m, t in zip(self.motions, turns, strict=True)]
                return [observe(rig, motion, self._fineness) for motion in motions]
        if key not in self._known:
            self._known[key] = [observe(rig, motion, self._fineness) for motion in self.motions]
        return self._known[key]

    def difference(self, rig: Rig, other: Rig) -> Array:
        """What `rig` shows less a replay of the other by the base angle that `rig` shows.

        Returns:
          Over the noise; all samples of all trials and signals that the log has, in a row.
        """
        true = self.show(rig)
        return self._in_a_row(true) - self._in_a_row(self.show(other, true))

    def signature(self, rig: Rig, other: Rig) -> float:
        """Root mean square of the difference."""
        return rms(self.difference(rig, other))

    def _in_a_row(self, traces: list[Trace]) -> Array:
        parts = []
        for motion, trace in zip(self.motions, traces, strict=True):
            values = {TIP: trace.tip_deg, TORQUE: trace.torque_n_mm}
            for signal in self.sensors.shown:
                parts.append(values[signal][:: motion.per_sample] / self.sensors.noise[signal])
        return np.concatenate(parts)


def rms(values: Array) -> float:
    """Root mean square."""
    return float(np.sqrt(np.mean(values**2)))


def _thinned(motion: Motion) -> Motion:
    """The same motion on a coarse time grid, all of whose points count as samples."""
    every = max(round(COARSE_STEP_S / motion.dt_s), 1)
    tip_torque = motion.tip_torque_n_mm
    return Motion(
        dt_s=motion.dt_s * every,
        per_sample=1,
        base_deg=motion.base_deg[::every],
        inserted_mm=motion.inserted_mm[::every],
        free_mm=motion.free_mm[::every],
        speed_mm_s=motion.speed_mm_s[::every],
        tip_torque_n_mm=None if tip_torque is None else tip_torque[::every],
    )
