"""Runs that a rig can do, as its log shows: depths, free lengths, axial speeds and rates of turning.

One whose log never slides may still be able to: such runs say that they ask for it.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from diagnosis.prepare.prepared_log import PreparedLog, PreparedTrial
from diagnosis.residuals.motion import base_rate

Array = NDArray[np.float64]

SAMPLE_S = 0.04
_REST_S = 0.5
_SLOW_MM_S = 1.0


@dataclass(frozen=True, kw_only=True)
class Experiment:
    """A run that a rig can do, in words and as a trial without readings."""

    words: str
    trial: PreparedTrial


def experiments(log: PreparedLog) -> Iterator[Experiment]:
    """Turns, staircases, slow ramps and oscillations, at rest and sliding, at two depths."""
    rates = np.concatenate(
        [np.abs(base_rate(trial.time_s, trial.base_motion_deg)) for trial in log.trials]
    )
    fast, slow = max(float(np.quantile(rates, 0.99)), 10.0), 5.0
    depths = sorted({round(float(np.median(trial.inserted_mm)), 1) for trial in log.trials})
    free = float(np.median(np.concatenate([trial.free_mm for trial in log.trials])))
    speed_seen = max(float(np.abs(trial.speed_mm_s).max()) for trial in log.trials)
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


def _ramps(rate: float, corners: tuple[float, ...]) -> tuple[Array, Array]:
    """Time and angle of turns at a rate, with a hold of two seconds after each."""
    time, angle = [0.0, _REST_S], [0.0, 0.0]
    for corner in corners:
        turned = abs(corner - angle[-1]) / rate
        time += [time[-1] + max(turned, SAMPLE_S), time[-1] + max(turned, SAMPLE_S) + 2.0]
        angle += [corner, corner]
    even = np.arange(0.0, time[-1], SAMPLE_S)
    return even, np.interp(even, time, angle)


def _sine(amplitude: float, hertz: float) -> tuple[Array, Array]:
    time = np.arange(0.0, 10.0, SAMPLE_S)
    running = np.maximum(time - _REST_S, 0.0)
    return time, amplitude * np.sin(2 * np.pi * hertz * running)


def _trial(time: Array, angle: Array, depth: float, free: float, speed: float) -> PreparedTrial:
    """Tissue of constant depth, through which the shaft slides out of the free length."""
    return PreparedTrial(
        name="proposal",
        time_s=time,
        base_motion_deg=angle,
        inserted_mm=np.full(time.shape, depth),
        free_mm=free - speed * time,
        speed_mm_s=np.full(time.shape, speed),
        tip_torque_n_mm=None,
        readings={},
        logged=np.zeros(time.shape, bool),
    )
