"""The run that would best tell two explanations apart, found by simulating candidates.

A rig can do what its log shows that it can: depths, free lengths, axial speeds and
rates of turning are taken from there. One whose log never slides may still be able
to: such runs say that they ask for it. Each candidate run is predicted by both
explanations; their difference d over the noise, less what either could take back by
moving its parameters within what the log leaves open, is the expected separation

    sqrt(d' (1 + Ja Ca Ja' + Jb Cb Jb')^-1 d),

in standard deviations of a test between the two.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from diagnosis.evidence import COARSE, Evidence
from diagnosis.fit import Fit
from diagnosis.held_out import information
from diagnosis.predict import predict
from diagnosis.rig_log import SENSORS, RigLog, Trial
from diagnosis.where import base_rate

Array = NDArray[np.float64]

_SAMPLE_S = 0.04
_REST_S = 0.5
_SLOW_MM_S = 1.0
_DIFFERENCE = 1e-3
DECISIVE = 5.0  # separation at which one run leaves hardly a doubt


@dataclass(frozen=True, kw_only=True)
class Experiment:
    """A run that a rig can do, in words and as a trial without readings."""

    words: str
    trial: Trial


@dataclass(frozen=True, kw_only=True)
class Proposal:
    """A run, and by how many standard deviations it would tell two explanations apart."""

    experiment: Experiment
    separation: float


def best_experiment(evidence: Evidence, one: Fit, other: Fit) -> Proposal:
    """Of the runs that the rig can do, the one that separates two fits best."""
    proposals = [
        Proposal(experiment=e, separation=separation(evidence, e, one, other))
        for e in experiments(evidence.log)
    ]
    return max(proposals, key=lambda p: p.separation)


def experiments(log: RigLog) -> Iterator[Experiment]:
    """Turns, staircases, slow ramps and oscillations, at rest and sliding, at two depths."""
    rates = np.concatenate([np.abs(base_rate(trial)) for trial in log.trials])
    fast, slow = max(float(np.quantile(rates, 0.99)), 10.0), 5.0
    depths = sorted({round(float(np.median(trial["inserted_mm"])), 1) for trial in log.trials})
    free = float(np.median(np.concatenate([trial["free_mm"] for trial in log.trials])))
    speed_seen = max(float(np.abs(trial["speed_mm_s"]).max()) for trial in log.trials)
    motions = {
        f"turn by 90 deg at {fast:.0f} deg/s, hold, turn back by 45 deg": _ramps(
            fast, (90.0, 45.0, 45.0)
        ),
        f"turn by 360 deg at {fast:.0f} deg/s, hold, turn back": _ramps(fast, (360.0, 360.0, 0.0)),
        f"turn by 30 deg at {slow:.0f} deg/s, hold, turn back": _ramps(slow, (30.0, 30.0, 0.0)),
        f"small steps of 2 deg at {fast:.0f} deg/s, up and down": _ramps(
            fast, (2.0, 4.0, 6.0, 4.0, 2.0, 0.0)
        ),
        "oscillate by 20 deg at 0.5 Hz": _sine(20.0, 0.5),
        "oscillate by 5 deg at 2 Hz": _sine(5.0, 2.0),
    }
    for depth in dict.fromkeys((depths[0], depths[-1])):
        for speed, able in (
            (0.0, ""),
            (speed_seen or _SLOW_MM_S, "" if speed_seen else ", if the rig can"),
        ):
            for words, (time, angle) in motions.items():
                sliding = f", sliding out at {speed:g} mm/s{able}" if speed else ""
                where = f", {depth:g} mm deep with {free:.0f} mm free{sliding}"
                yield Experiment(words=words + where, trial=_trial(time, angle, depth, free, -speed))


def separation(evidence: Evidence, experiment: Experiment, one: Fit, other: Fit) -> float:
    """Expected standard deviations between two fits on a run of both sensors that the log has."""
    a, spread_a = _outlook(evidence, experiment.trial, one)
    b, spread_b = _outlook(evidence, experiment.trial, other)
    d = a - b
    loose = np.concatenate([spread_a, spread_b], axis=1)
    # Woodbury: (1 + L L')^-1 d, with the few columns of L.
    held = np.linalg.solve(np.eye(loose.shape[1]) + loose.T @ loose, loose.T @ d)
    return float(np.sqrt(max(float(d @ d - (loose.T @ d) @ held), 0.0)))


def _outlook(evidence: Evidence, trial: Trial, fit: Fit) -> tuple[Array, Array]:
    """Readings over noise that a fit expects, and how its parameters' spread moves them."""
    steps = np.vstack([np.zeros(fit.x.size), _DIFFERENCE * np.eye(fit.x.size)])
    rigs = [fit.coordinates.rig(fit.x + step) for step in steps]
    per_sample = float(np.sqrt(_SAMPLE_S / np.median(np.diff(evidence.log.trials[0]["time_s"]))))
    seen = [s for s in SENSORS if any(t.has(s) for t in evidence.log.trials)]
    readings = [
        np.concatenate([p[s] / evidence.noise[s] * per_sample for s in seen])
        for p in predict(evidence.log.rig, trial, rigs, COARSE)
    ]
    slopes = [(moved - readings[0]) / _DIFFERENCE for moved in readings[1:]]
    if not slopes:
        return readings[0], np.zeros((readings[0].size, 0))
    root = np.linalg.cholesky(np.linalg.pinv(information(fit)) + 1e-12 * np.eye(fit.x.size))
    return readings[0], np.stack(slopes, axis=-1) @ root


def _ramps(rate: float, corners: tuple[float, ...]) -> tuple[Array, Array]:
    """Time and angle of turns at a rate, with a hold of two seconds after each."""
    time, angle = [0.0, _REST_S], [0.0, 0.0]
    for corner in corners:
        turned = abs(corner - angle[-1]) / rate
        time += [time[-1] + max(turned, _SAMPLE_S), time[-1] + max(turned, _SAMPLE_S) + 2.0]
        angle += [corner, corner]
    even = np.arange(0.0, time[-1], _SAMPLE_S)
    return even, np.interp(even, time, angle)


def _sine(amplitude: float, hertz: float) -> tuple[Array, Array]:
    time = np.arange(0.0, 10.0, _SAMPLE_S)
    running = np.maximum(time - _REST_S, 0.0)
    return time, amplitude * np.sin(2 * np.pi * hertz * running)


def _trial(time: Array, angle: Array, depth: float, free: float, speed: float) -> Trial:
    """Tissue of constant depth, through which the shaft slides out of the free length."""
    table = pd.DataFrame(
        {
            "time_s": time,
            "base_angle_deg": angle,
            "inserted_mm": depth,
            "free_mm": free - speed * time,
            "speed_mm_s": speed,
        }
    )
    return Trial(name="proposal", table=table)
