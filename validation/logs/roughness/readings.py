"""Roughness of readings: coloured noise, coarse quantisation, and outliers."""

import numpy as np
from numpy.random import Generator

from validation.logs.profiles import log_uniform
from validation.logs.roughness.roughness import Array, Columns, Noise, Roughness
from validation.logs.sensors import BASE, MEASURED, TIP, TORQUE, LogSensors

LOG_SIGMAS = float(np.log(5)), float(np.log(100))
"""Logarithms of the smallest and the largest outlier / sigma."""


def first_order(times: Array, white: Array, time_constant_s: float) -> Array:
    """First-order noise of the same variance, made from white noise (AR(1) on a uniform grid).

    x_i = a x_(i-1) + sqrt(1 - a^2) e_i with a = exp(-(t_i - t_(i-1)) / time constant).
    """
    kept = np.exp(-np.diff(times) / time_constant_s)
    fresh = np.sqrt(1 - kept**2) * white[1:]
    coloured = white.copy()
    for i in range(1, white.size):
        coloured[i] = kept[i - 1] * coloured[i - 1] + fresh[i - 1]
    return coloured


def coloured_noise(rng: Generator) -> Roughness:
    """First-order noise with a correlation time of 10 to 200 ms; sometimes white noise is added."""
    time_constant_s = log_uniform(rng, 0.01, 0.2)
    signals = _some_of_the_measured(rng)
    share = 1.0 if rng.random() < 0.65 else rng.uniform(0.3, 0.8)
    own = np.random.default_rng(int(rng.integers(2**32)))

    def noise(times: Array, white: Noise) -> Noise:
        changed = dict(white)
        for signal in signals:
            coloured = first_order(times, white[signal], time_constant_s)
            other = own.normal(0, white[signal].std(), times.size)
            changed[signal] = np.sqrt(share) * coloured + np.sqrt(1 - share) * other
        return changed

    numbers = {
        "time_constant_s": time_constant_s,
        "signals": list(signals),
        "share_of_variance": float(share),
    }
    return Roughness(name="coloured_noise", numbers=numbers, noise=noise)


def quantisation(rng: Generator) -> Roughness:
    """Steps of 1 to 5 sigma for tip or torque, of 0.1 to 0.5 deg for the base; in one or two of them."""
    chosen = [str(s) for s in rng.choice((*MEASURED, BASE), int(rng.integers(1, 3)), replace=False)]
    sigmas = {signal: log_uniform(rng, 1, 5) for signal in chosen if signal != BASE}
    base_deg = log_uniform(rng, 0.1, 0.5)

    def columns(_: Generator, sensors: LogSensors, trials: list[Columns]) -> list[Columns]:
        steps = {signal: size * sensors.noise[signal] for signal, size in sigmas.items()}
        steps |= {BASE: base_deg} if BASE in chosen else {}
        rounded = [
            {name: np.round(t[name] / step) * step for name, step in steps.items()} for t in trials
        ]
        return [trial | own for trial, own in zip(trials, rounded, strict=True)]

    numbers = {"steps_sigma": sigmas, **({"base_step_deg": base_deg} if BASE in chosen else {})}
    return Roughness(name="quantisation", numbers=numbers, columns=columns)


def outliers(rng: Generator) -> Roughness:
    """0.2 to 2 % of the samples are off by 5 to 100 sigma, alone or two in a row."""
    share, doubled = log_uniform(rng, 0.002, 0.02), rng.choice([0.0, 0.3])
    signals = (*_some_of_the_measured(rng), *((BASE,) if rng.random() < 0.2 else ()))

    def columns(rng: Generator, sensors: LogSensors, trials: list[Columns]) -> list[Columns]:
        return [
            trial | {s: trial[s] + _spikes(rng, trial[s].size, sensors.noise[s]) for s in signals}
            for trial in trials
        ]

    def _spikes(rng: Generator, count: int, sigma: float) -> Array:
        hit = np.flatnonzero(rng.random(count) < share / (1 + doubled))
        sizes = sigma * rng.choice([-1, 1], hit.size) * np.exp(rng.uniform(*LOG_SIGMAS, hit.size))
        again = (rng.random(hit.size) < doubled) & (hit + 1 < count)
        spikes = np.zeros(count)
        spikes[hit[again] + 1] = sizes[again]
        spikes[hit] = sizes
        return spikes

    numbers = {"share": share, "signals": list(signals), "two_in_a_row": float(doubled)}
    return Roughness(name="outliers", numbers=numbers, columns=columns)


def _some_of_the_measured(rng: Generator) -> tuple[str, ...]:
    choices = ((TIP,), (TORQUE,), (TIP, TORQUE))
    return choices[int(rng.integers(len(choices)))]
