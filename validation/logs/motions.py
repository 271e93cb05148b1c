"""The motions of a log: how its trials turn and slide, their depth, duration and sampling rate."""

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from validation.logs.profiles import PROFILES, held, log_uniform
from validation.rig.motion import TrialMotion

Array = NDArray[np.float64]

FINEST_STEP_S = 2.5e-3
LEAST_TRIALS = 3
LEAST_FREE_MM, MOST_FREE_MM = 20.0, 200.0


@dataclass(frozen=True, kw_only=True)
class LogPlan:
    """The common properties of a log's trials.

    Attributes:
      sliding, growing, loaded: shares of trials that slide, that change the inserted length, and that
        have a known torque at the tip.
    """

    trials: int
    total_s: float
    rate_hz: int
    sliding: float
    growing: float
    loaded: float


def draw_plan(rng: np.random.Generator, *, short: bool, slides: bool, loads: bool) -> LogPlan:
    """Draw a plan; `slides`, `loads`: the effect is only visible if trials slide, or are loaded."""
    rates, weights = ((50, 100), (0.4, 0.6)) if short else ((50, 100, 200), (0.12, 0.78, 0.1))
    sliding = rng.choice([0.0, 0.4, 0.8], p=[0.35, 0.35, 0.3])
    growing = 0.4 if rng.random() < 0.15 else 0.0
    loaded = 0.4 if rng.random() < 0.06 else 0.0
    return LogPlan(
        trials=LEAST_TRIALS if short else int(rng.integers(LEAST_TRIALS, 7)),
        total_s=rng.uniform(36, 44) if short else rng.uniform(60, 180),
        rate_hz=int(rng.choice(rates, p=weights)),
        sliding=max(sliding, 0.7) if slides else sliding,
        growing=growing,
        loaded=0.7 if loads else loaded,
    )


def draw_motions(rng: np.random.Generator, plan: LogPlan) -> list[TrialMotion]:
    """The trials of a log."""
    shares = rng.uniform(0.5, 1.5, plan.trials)
    durations = np.clip(plan.total_s * shares / shares.sum(), 10.0, 60.0)
    depth = rng.uniform(40, 160)
    same_depth = rng.random() < 0.3
    flags = [_some(rng, plan.trials, share) for share in (plan.sliding, plan.growing, plan.loaded)]
    motions = []
    for i in range(plan.trials):
        depth = depth if same_depth else rng.uniform(40, 160)
        kind = tuple(bool(flag[i]) for flag in flags)
        motion = _draw_motion(rng, plan.rate_hz, float(durations[i]), depth, kind)
        motions.append(replace(motion, trial=i))
    return motions


def _some(rng: np.random.Generator, count: int, share: float) -> Array:
    """A share of the trials, drawn at random: at least one if the share is above 0."""
    chosen = np.zeros(count, bool)
    chosen[: math.ceil(share * count)] = True
    return np.asarray(rng.permutation(chosen))


def _draw_motion(
    rng: np.random.Generator, rate_hz: int, duration_s: float, depth: float, kind: tuple[bool, ...]
) -> TrialMotion:
    sliding, growing, loaded = kind
    per_sample = max(math.ceil(1 / rate_hz / FINEST_STEP_S - 1e-9), 1)
    dt = 1 / rate_hz / per_sample
    time_s: Array = np.arange(int(duration_s * rate_hz) * per_sample + 1, dtype=float) * dt
    names = list(PROFILES)
    weights = np.array([PROFILES[name][1] for name in names])
    name = str(rng.choice(names, p=weights / weights.sum()))
    largest_rate = log_uniform(rng, 60, 280)
    profile = held if loaded and rng.random() < 0.5 else PROFILES[name][0]
    speed, inserted, free = _slide(rng, time_s, depth, sliding, growing)
    return TrialMotion(
        dt_s=dt,
        per_sample=per_sample,
        base_deg=profile(rng, time_s, largest_rate),
        inserted_mm=inserted,
        free_mm=free,
        speed_mm_s=speed,
        tip_torque_n_mm=_load(rng, time_s) if loaded else None,
    )


def _slide(
    rng: np.random.Generator, time_s: Array, depth: float, sliding: bool, growing: bool
) -> tuple[Array, Array, Array]:
    """Axial speed, mm/s, inserted and free length, mm."""
    free = rng.uniform(40, 160)
    if not (sliding or growing):
        rest = np.zeros_like(time_s)
        return rest, rest + depth, rest + free
    speed = _speed(rng, time_s)
    dt = time_s[1]
    travel = np.concatenate(([0.0], np.cumsum((speed[1:] + speed[:-1]) / 2) * dt))
    largest = 90.0 if growing else 110.0
    size = float(np.ptp(travel))
    if size > largest:
        speed, travel = speed * largest / size, travel * largest / size
    free = min(max(free, LEAST_FREE_MM + travel.max()), MOST_FREE_MM + travel.min())
    if not growing:
        return speed, np.full_like(time_s, depth), free - travel
    start = min(max(depth - travel[-1] / 2, 25.0 - travel.min()), 170.0 - travel.max())
    return speed, start + travel, free - travel


def _speed(rng: np.random.Generator, time_s: Array) -> Array:
    """Axial speed: constant, during part of the trial, or forth and back; edges take 0.1 s."""
    size = rng.choice([-1, 1]) * log_uniform(rng, 0.5, 5.0)
    kind = rng.choice(["always", "part", "both ways"], p=[0.4, 0.35, 0.25])
    end = time_s[-1]
    if kind == "always":
        return np.full_like(time_s, size)
    begin, length = rng.uniform(0.05, 0.5) * end, rng.uniform(0.2, 0.45) * end
    edge = 0.1
    pulse = np.clip((time_s - begin) / edge, 0, 1) - np.clip((time_s - begin - length) / edge, 0, 1)
    if kind == "both ways":
        back = begin + length + rng.uniform(0, 0.05) * end
        pulse -= np.clip((time_s - back) / edge, 0, 1)
        pulse += np.clip((time_s - back - length) / edge, 0, 1)
    return np.asarray(size * pulse)


def _load(rng: np.random.Generator, time_s: Array) -> Array:
    """A known torque at the tip, N mm: a sine, or steps with smooth edges."""
    size = log_uniform(rng, 0.3, 2.0)
    if rng.random() < 0.5:
        frequency = log_uniform(rng, 1.0 / time_s[-1], 0.3)
        return np.asarray(size * np.sin(2 * np.pi * frequency * time_s))
    edges = np.sort(rng.uniform(0.05, 0.95, 4)) * time_s[-1]
    levels = np.diff(np.concatenate(([0.0], rng.uniform(-size, size, 4))))
    return np.asarray(levels @ np.clip((time_s - edges[:, None]) / 0.3, 0, 1))
