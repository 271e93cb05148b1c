"""Roughness of time: jitter of time stamps, clock drift, lost samples, and other sampling rates."""

from dataclasses import replace

import numpy as np
from numpy.random import Generator

from validation.logs.motions import LogPlan
from validation.logs.profiles import log_uniform
from validation.logs.roughness.roughness import Array, Columns, Roughness
from validation.logs.sensors import MEASURED, TIP, LogSensors
from validation.rig.motion import TrialMotion
from validation.rig.unmodelled.effect import IdealSignals

RATES_HZ = (20, 25, 33, 250, 500, 1000)
SHORT_FROM_HZ, SHORT_S, FEW = 500, 60.0, 4
"""From this rate on, a log has at most so many seconds, in at most so many trials."""
LEAST_SPACING = 0.1
"""Stamps stay apart by this share of the sampling interval."""


def time_jitter(rng: Generator) -> Roughness:
    """Time stamps jitter by 0.5 to 3 ms rms; or the sampling does, with correct stamps.

    The jitter is at most a quarter of the sampling interval. Stamps stay strictly increasing.
    """
    rms_s, right = log_uniform(rng, 0.5e-3, 3e-3), bool(rng.random() < 0.5)

    def instants(rng: Generator, times: Array) -> Array:
        return jittered(rng, times, rms_s) if right else times

    def columns(rng: Generator, _: LogSensors, trials: list[Columns]) -> list[Columns]:
        if right:
            return trials
        return [trial | {"time_s": jittered(rng, trial["time_s"], rms_s)} for trial in trials]

    numbers = {"rms_s": rms_s, "stamped_correctly": right}
    return Roughness(name="time_jitter", numbers=numbers, instants=instants, columns=columns)


def jittered(rng: Generator, times: Array, rms_s: float) -> Array:
    """Times with jitter of that size, still in order; the first and the last one are unchanged."""
    interval = float(np.diff(times).min())
    furthest = (1 - LEAST_SPACING) / 2 * interval
    off = np.clip(rng.normal(0, min(rms_s, interval / 4), times.size), -furthest, furthest)
    off[[0, -1]] = 0.0
    return np.asarray(times + off)


def sensor_clock(
    rng: Generator,
    low: float = 2e-4,
    high: float = 0.01,
    signals: tuple[str, ...] = (),
    *,
    name: str = "sensor_clock",
) -> Roughness:
    """At time t of a trial, tip or torque shows its value at t (1 + error).

    The recording ends where the signals of the trial end.
    """
    chosen = signals or (str(rng.choice(MEASURED)),)
    error = rng.choice([-1, 1]) * log_uniform(rng, low, high)

    def shown(motion: TrialMotion, ideal: IdealSignals) -> IdealSignals:
        start = ideal.time_s[motion.lead]
        read_at = start + (ideal.time_s - start) * (1 + error)
        kept = read_at <= ideal.time_s[-1]
        names = ["tip_deg" if signal == TIP else "torque_n_mm" for signal in chosen]
        read = {n: np.interp(read_at, ideal.time_s, getattr(ideal, n)) for n in names}
        fields = {
            n: getattr(ideal, n) for n in ("time_s", "base_deg", "torque_n_mm", "tip_deg", "speed_mm_s")
        }
        return replace(ideal, **{n: values[kept] for n, values in (fields | read).items()})

    return Roughness(name=name, numbers={"signals": list(chosen), "error": float(error)}, signals=shown)


def dropped_samples(rng: Generator) -> Roughness:
    """5 to 30 % of the rows are lost, or some gaps of 0.1 to 1 s, or both; the first row is kept."""
    kind = str(rng.choice(["rows", "gaps", "both"]))
    share = log_uniform(rng, 0.05, 0.3) if kind != "gaps" else 0.0
    most = 0 if kind == "rows" else int(rng.integers(2, 6))

    def columns(rng: Generator, _: LogSensors, trials: list[Columns]) -> list[Columns]:
        return [
            {name: values[kept] for name, values in trial.items()}
            for trial in trials
            for kept in [_kept(rng, trial["time_s"])]
        ]

    def _kept(rng: Generator, time_s: Array) -> Array:
        kept = rng.random(time_s.size) >= share
        for _ in range(int(rng.integers(1, most)) if most else 0):
            start, length = rng.uniform(0.1, time_s[-1] - 1.1), log_uniform(rng, 0.1, 1.0)
            kept &= (time_s < start) | (time_s > start + length)
        kept[0] = True
        return np.asarray(kept)

    numbers = {"share": share, "most_gaps": max(most - 1, 0)}
    return Roughness(name="dropped_samples", numbers=numbers, columns=columns)


def sampling_rate(rng: Generator) -> Roughness:
    """20 Hz to 1 kHz, with the same noise per sample; fast logs are short."""
    rate_hz = int(rng.choice(RATES_HZ))

    def plan(given: LogPlan) -> LogPlan:
        if rate_hz < SHORT_FROM_HZ:
            return replace(given, rate_hz=rate_hz)
        total_s, trials = min(given.total_s, SHORT_S), min(given.trials, FEW)
        return replace(given, rate_hz=rate_hz, total_s=total_s, trials=trials)

    return Roughness(name="sampling_rate", numbers={"rate_hz": rate_hz}, plan=plan)
