"""The ten roughnesses by name, and a recording with some of them."""

from collections.abc import Callable, Sequence
from itertools import combinations

import numpy as np
from numpy.random import Generator

from validation.logs.roughness.late_start import late_start
from validation.logs.roughness.readings import coloured_noise, outliers, quantisation
from validation.logs.roughness.roughness import Columns, Roughness
from validation.logs.roughness.timing import dropped_samples, sampling_rate, sensor_clock, time_jitter
from validation.logs.roughness.torque import low_pass_torque, torque_drift
from validation.logs.sensors import BASE, TIP, TORQUE, LogSensors, channels
from validation.rig.motion import TrialMotion
from validation.rig.unmodelled.effect import IdealSignals

ROUGHNESSES: dict[str, Callable[[Generator], Roughness]] = {
    "coloured_noise": coloured_noise,
    "torque_drift": torque_drift,
    "time_jitter": time_jitter,
    "sensor_clock": sensor_clock,
    "quantisation": quantisation,
    "outliers": outliers,
    "low_pass_torque": low_pass_torque,
    "dropped_samples": dropped_samples,
    "sampling_rate": sampling_rate,
    "late_start": late_start,
}
"""In the order in which they change the columns."""
INCOMPATIBLE = ({"coloured_noise", "low_pass_torque"},)
"""Both give the noise of the torque its memory."""
PAIRS = tuple(pair for pair in combinations(ROUGHNESSES, 2) if {*pair} not in INCOMPATIBLE)


def record(
    rng: Generator,
    sensors: LogSensors,
    roughness: Sequence[Roughness],
    motions: Sequence[TrialMotion],
    signals: Sequence[IdealSignals],
) -> list[Columns]:
    """The columns of all trials, as rough sensors record them.

    Args:
      roughness: in the order of `ROUGHNESSES`.
      motions, signals: of every trial, on its fine grid.
    """
    trials = [_sampled(rng, sensors, roughness, *trial) for trial in zip(motions, signals, strict=True)]
    for one in roughness:
        trials = one.columns(rng, sensors, trials)
    return trials


def _sampled(
    rng: Generator,
    sensors: LogSensors,
    roughness: Sequence[Roughness],
    motion: TrialMotion,
    ideal: IdealSignals,
) -> Columns:
    """A trial's columns with their noise."""
    for one in roughness:
        ideal = one.signals(motion, ideal)
    times = ideal.time_s[motion.recorded]
    for one in roughness:
        times = one.instants(rng, times)
    columns = {
        name: np.interp(times, ideal.time_s, values[: ideal.time_s.size])
        for name, values in channels(motion, ideal).items()
    }
    columns["time_s"] = times - times[0]
    noise = {signal: rng.normal(0, sensors.noise[signal], times.size) for signal in (BASE, TORQUE, TIP)}
    for one in roughness:
        noise = one.noise(times, noise)
    return columns | {signal: columns[signal] + own for signal, own in noise.items()}
