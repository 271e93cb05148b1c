"""How the drive shaft turns: profiles of base angle over time, deg, all starting at 0 at rest.

Each takes a generator, a time grid, s, and the largest rate, deg/s; it returns (N,), deg.
"""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Profile = Callable[[np.random.Generator, Array, float], Array]


def log_uniform(rng: np.random.Generator, low: float, high: float) -> float:
    """A draw whose logarithm is uniform."""
    return float(np.exp(rng.uniform(np.log(low), np.log(high))))


def min_jerk(share: Array) -> Array:
    """From 0 to 1 at rest at both ends."""
    s = np.clip(share, 0.0, 1.0)
    return np.asarray(s**3 * (10.0 - 15.0 * s + 6.0 * s**2))


def steady(share: Array) -> Array:
    """From 0 to 1 at constant rate."""
    return np.clip(share, 0.0, 1.0)


def moves(
    time_s: Array, turns: list[tuple[float, float, float]], shape: Callable[[Array], Array]
) -> Array:
    """Successive turns: (angle, deg; duration, s; hold, s)."""
    base, start = np.zeros_like(time_s), 0.0
    for by, duration, hold in turns:
        base += by * shape((time_s - start) / duration)
        start += duration + hold
    return base


def staircase(rng: np.random.Generator, time_s: Array, rate: float) -> Array:
    """Turn and hold, mostly one way, then the other."""
    step = rng.uniform(20, 150)
    duration = max(step / rate * rng.uniform(1, 4), 0.2)
    hold = rng.uniform(0.8, 4.0)
    count = int(time_s[-1] / (duration + hold)) + 1
    back_after = int(rng.integers(2, max(count, 3)))
    ways = [1 if i < back_after else -1 for i in range(count)]
    return moves(time_s, [(way * step, duration, hold) for way in ways], _shape(rng))


def back_and_forth(rng: np.random.Generator, time_s: Array, rate: float) -> Array:
    """To one side and back, repeatedly, with or without holds."""
    amplitude = log_uniform(rng, 30, 500)
    duration = max(amplitude / rate * rng.uniform(1, 3), 0.3)
    hold = rng.choice([0.0, 0.0, 0.5, 2.0])
    count = int(time_s[-1] / (duration + hold)) + 1
    side = rng.choice([-1, 1])
    centre = rng.choice([0.5, 1.0])
    first = (side * amplitude * centre, duration * centre, hold)
    turns = [(side * amplitude * (-1) ** i, duration, hold) for i in range(1, count + 1)]
    return moves(time_s, [first, *turns], _shape(rng))


def sine(rng: np.random.Generator, time_s: Array, rate: float) -> Array:
    """A sine, starting at rest."""
    frequency = log_uniform(rng, 1.5 / time_s[-1], 0.8)
    amplitude = min(rate / (2 * np.pi * frequency), 500) * rng.uniform(0.4, 1)
    onset = min_jerk(time_s * frequency)
    return np.asarray(amplitude * onset * np.sin(2 * np.pi * frequency * time_s))


def multisine(rng: np.random.Generator, time_s: Array, rate: float) -> Array:
    """A sum of sines of similar rate, starting at rest."""
    frequencies = [log_uniform(rng, 1.0 / time_s[-1], 1.2) for _ in range(int(rng.integers(3, 6)))]
    base = np.zeros_like(time_s)
    for frequency in frequencies:
        amplitude = min(rate / (2 * np.pi * frequency), 400) * rng.uniform(0.3, 1) / len(frequencies)
        base += amplitude * np.sin(2 * np.pi * frequency * time_s + rng.uniform(0, 2 * np.pi))
    return np.asarray((base - base[0]) * min_jerk(time_s / 2.0))


def chirp(rng: np.random.Generator, time_s: Array, rate: float) -> Array:
    """A sine of rising frequency and falling amplitude."""
    low, high = 1.0 / time_s[-1], rng.uniform(0.4, 1.5)
    growth = np.log(high / low) / time_s[-1]
    frequency = low * np.exp(growth * time_s)
    phase = 2 * np.pi * (frequency - low) / growth
    amplitude = np.minimum(rate / (2 * np.pi * frequency), 360) * rng.uniform(0.4, 1)
    return np.asarray(amplitude * min_jerk(time_s / 2.0) * np.sin(phase))


def slow_ramp(rng: np.random.Generator, time_s: Array, rate: float) -> Array:
    """Slowly to one side, then back."""
    slow = min(log_uniform(rng, 4, 40), rate)
    share = rng.uniform(0.4, 0.65)
    there_s, hold = share * time_s[-1], rng.choice([0.0, 1.0, 3.0])
    side = rng.choice([-1, 1])
    back_s = max((1 - share) * time_s[-1] - hold, 1.0)
    there, back = (side * slow * there_s, there_s, hold), (-side * slow * back_s, back_s, 0.0)
    return moves(time_s, [there, back], steady)


def fast_turns(rng: np.random.Generator, time_s: Array, rate: float) -> Array:
    """Sudden turns to either side with long holds."""
    turns: list[tuple[float, float, float]] = []
    while sum(duration + hold for _, duration, hold in turns) < time_s[-1]:
        by = rng.choice([-1, 1]) * rng.uniform(60, 300)
        turns.append((by, abs(by) / (rate * rng.uniform(0.5, 0.9)), rng.uniform(1.5, 5.0)))
    return moves(time_s, turns, _shape(rng))


def wander(rng: np.random.Generator, time_s: Array, rate: float) -> Array:
    """Smooth turns to random targets, some of them distant, with some holds."""
    turns: list[tuple[float, float, float]] = []
    where = 0.0
    while sum(duration + hold for _, duration, hold in turns) < time_s[-1]:
        target = rng.normal(0, 250)
        duration = max(abs(target - where) / rate * rng.uniform(1.9, 5), 0.4)
        turns.append((target - where, duration, rng.choice([0.0, 0.3, 1.5])))
        where = target
    return moves(time_s, turns, min_jerk)


def held(rng: np.random.Generator, time_s: Array, rate: float) -> Array:
    """One turn, then a long hold."""
    by = rng.choice([-1, 1]) * rng.uniform(60, 400)
    return moves(time_s, [(by, max(abs(by) / rate * rng.uniform(1.5, 4), 0.3), 0.0)], min_jerk)


def _shape(rng: np.random.Generator) -> Callable[[Array], Array]:
    return min_jerk if rng.random() < 0.5 else steady


PROFILES: dict[str, tuple[Profile, float]] = {
    "staircase": (staircase, 0.18),
    "back_and_forth": (back_and_forth, 0.2),
    "sine": (sine, 0.12),
    "multisine": (multisine, 0.1),
    "chirp": (chirp, 0.08),
    "slow_ramp": (slow_ramp, 0.1),
    "fast_turns": (fast_turns, 0.1),
    "wander": (wander, 0.12),
}
"""Profiles and how often they are drawn."""
