"""Roughness of the torque sensor: slow drift, and a filter of first order."""

from dataclasses import replace

import numpy as np
from numpy.random import Generator

from validation.logs.profiles import log_uniform
from validation.logs.roughness.readings import first_order
from validation.logs.roughness.roughness import Array, Columns, Noise, Roughness
from validation.logs.sensors import TORQUE, LogSensors
from validation.rig.filters import low_passed
from validation.rig.motion import TrialMotion
from validation.rig.unmodelled.effect import IdealSignals


def torque_drift(rng: Generator) -> Roughness:
    """The torque drifts by 1 to 5 sigma within a trial: a line, a random walk or a slow sine.

    It starts at 0 in each trial, or continues from its value at the end of the last one.
    """
    shape, goes_on = str(rng.choice(["line", "walk", "sine"])), bool(rng.random() < 0.5)
    low, high = sorted(log_uniform(rng, 1, 5) for _ in range(2))

    def columns(rng: Generator, sensors: LogSensors, trials: list[Columns]) -> list[Columns]:
        drifted, start = [], 0.0
        for trial in trials:
            size = log_uniform(rng, low, high) * sensors.noise[TORQUE] * rng.choice([-1, 1])
            drift = start + size * _course(rng, shape, trial["time_s"])
            start = float(drift[-1]) if goes_on else 0.0
            drifted.append(trial | {TORQUE: trial[TORQUE] + drift})
        return drifted

    numbers = {"shape": shape, "goes_on": goes_on, "largest_sigma": [low, high]}
    return Roughness(name="torque_drift", numbers=numbers, columns=columns)


def _course(rng: Generator, shape: str, time_s: Array) -> Array:
    """Course of the drift over time, (N,): from 0, with a largest magnitude of 1."""
    share = time_s / time_s[-1]
    if shape == "sine":
        phase = rng.uniform(0, 2 * np.pi)
        course = np.sin(2 * np.pi * rng.uniform(0.5, 1.5) * share + phase) - np.sin(phase)
    elif shape == "walk":
        steps = rng.normal(0, 1, time_s.size - 1) * np.sqrt(np.diff(time_s))
        course = np.concatenate(([0.0], np.cumsum(steps)))
    else:
        course = share
    return np.asarray(course / np.abs(course).max())


def low_pass_torque(rng: Generator) -> Roughness:
    """A first-order filter of 2 to 20 Hz on the torque; its noise enters before or after the filter.

    In both cases the noise of the readings has the claimed standard deviation.
    """
    cut_off_hz, noise_before = log_uniform(rng, 2, 20), bool(rng.random() < 0.5)
    time_constant_s = 1 / (2 * np.pi * cut_off_hz)

    def signals(motion: TrialMotion, ideal: IdealSignals) -> IdealSignals:
        filtered = low_passed(ideal.torque_n_mm, motion.dt_s, time_constant_s)
        return replace(ideal, torque_n_mm=filtered)

    def noise(times: Array, white: Noise) -> Noise:
        if not noise_before:
            return white
        return white | {TORQUE: first_order(times, white[TORQUE], time_constant_s)}

    numbers = {"cut_off_hz": cut_off_hz, "noise_before": noise_before}
    return Roughness(name="low_pass_torque", numbers=numbers, signals=signals, noise=noise)
