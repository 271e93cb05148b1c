"""Runs that a rig can do, as its log shows: depths, free lengths, axial speeds and rates of turning.

If all trials have the same depth and never slide, the rig is assumed to have no axis: its runs differ
only in rate, amplitude, reversals and rests, and sliding runs are listed separately. A rig with an axis
that never slid may be able to: the words of such runs say that they need sliding.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from diagnosis.criteria.assessment import SAME_DEPTH_MM
from diagnosis.criteria.fitting import SLIDING_MM_S
from diagnosis.prepare.prepared_log import PreparedLog, PreparedTrial
from diagnosis.residuals.motion import base_rate

Array = NDArray[np.float64]

Motion = tuple[Array, Array]
"""Time, s, and angle of the base, deg, (N,) each."""

SAMPLE_S = 0.04
_REST_S = 0.5
_SLOW_MM_S = 1.0
_SLOW_DEG_S = 5.0
_FASTEST_AT_LEAST_DEG_S = 10.0


@dataclass(frozen=True, kw_only=True)
class Experiment:
    """A run that a rig can do, in words and as a trial without readings."""

    words: str
    trial: PreparedTrial


def has_axis(log: PreparedLog) -> bool:
    """Whether the log shows that its rig can move the needle axially: it slides, or depths differ."""
    depths = np.concatenate([trial.inserted_mm for trial in log.trials])
    slides = any(np.abs(trial.speed_mm_s).max() > SLIDING_MM_S for trial in log.trials)
    return slides or bool(np.ptp(depths) >= SAME_DEPTH_MM)


def experiments(log: PreparedLog) -> Iterator[Experiment]:
    """Runs that the rig can do: turns at rest; with an axis also sliding ones, and at two depths."""
    motions, depths, free = _motions(_fast_deg_s(log)), _depths_mm(log), _free_mm(log)
    if not has_axis(log):
        for words, (time, angle) in (motions | _rotary_motions()).items():
            yield Experiment(words=words, trial=_trial(time, angle, depths[0], free, 0.0))
        return
    speed_seen = max(float(np.abs(trial.speed_mm_s).max()) for trial in log.trials)
    for depth in dict.fromkeys((depths[0], depths[-1])):
        for speed, able in (
            (0.0, ""),
            (speed_seen or _SLOW_MM_S, "" if speed_seen else ", if the rig can"),
        ):
            for words, (time, angle) in motions.items():
                sliding = f", sliding out at {speed:g} mm/s{able}" if speed else ""
                where = f", {depth:g} mm deep with {free:.0f} mm free{sliding}"
                yield Experiment(words=words + where, trial=_trial(time, angle, depth, free, -speed))


def sliding_experiments(log: PreparedLog) -> Iterator[Experiment]:
    """Sliding runs for a rig that seems to have no axis: for what no turn of the base can tell."""
    depth, free = _depths_mm(log)[0], _free_mm(log)
    for words, (time, angle) in _motions(_fast_deg_s(log)).items():
        yield Experiment(
            words=f"{words}, sliding out at {_SLOW_MM_S:g} mm/s",
            trial=_trial(time, angle, depth, free, -_SLOW_MM_S),
        )


def _fast_deg_s(log: PreparedLog) -> float:
    """Rate of the base that 1 % of the samples exceed, deg/s."""
    each = [np.abs(base_rate(trial.time_s, trial.base_motion_deg)) for trial in log.trials]
    return max(float(np.quantile(np.concatenate(each), 0.99)), _FASTEST_AT_LEAST_DEG_S)


def _depths_mm(log: PreparedLog) -> list[float]:
    return sorted({round(float(np.median(trial.inserted_mm)), 1) for trial in log.trials})


def _free_mm(log: PreparedLog) -> float:
    return float(np.median(np.concatenate([trial.free_mm for trial in log.trials])))


def _motions(fast: float) -> dict[str, Motion]:
    """Turns, staircases, slow ramps and oscillations of the base, by their description.

    Args:
      fast: rate, deg/s.
    """
    return {
        f"turn by 90 deg at {fast:.0f} deg/s, hold, turn back by 45 deg": _ramps(
            fast, (90.0, 45.0, 45.0)
        ),
        f"turn by 360 deg at {fast:.0f} deg/s, hold, turn back": _ramps(fast, (360.0, 360.0, 0.0)),
        f"turn by 30 deg at {_SLOW_DEG_S:.0f} deg/s, hold, turn back": _ramps(
            _SLOW_DEG_S, (30.0, 30.0, 0.0)
        ),
        f"small steps of 2 deg at {fast:.0f} deg/s, up and down": _ramps(
            fast, (2.0, 4.0, 6.0, 4.0, 2.0, 0.0)
        ),
        "oscillate by 20 deg at 0.5 Hz": _sine(20.0, 0.5),
        "oscillate by 5 deg at 2 Hz": _sine(5.0, 2.0),
    }


def _rotary_motions() -> dict[str, Motion]:
    """More motions for a rig without an axis, which vary rate, amplitude, rests and reversals."""
    rest = (90.0,) * 10
    return {
        f"turn by 90 deg at {_SLOW_DEG_S:.0f} deg/s, hold, turn back by 45 deg": _ramps(
            _SLOW_DEG_S, (90.0, 45.0, 45.0)
        ),
        "turn by 90 deg at 30 deg/s, rest for 20 s, turn back": _ramps(30.0, (*rest, 0.0)),
        "reverse every 10 deg at 10 deg/s, without a rest": _sawtooth(10.0, 10.0),
        "oscillate by 90 deg at 0.2 Hz": _sine(90.0, 0.2),
    }


def _ramps(rate: float, corners: tuple[float, ...]) -> Motion:
    """Time and angle of turns at a rate, with a hold of two seconds after each."""
    time, angle = [0.0, _REST_S], [0.0, 0.0]
    for corner in corners:
        turned = abs(corner - angle[-1]) / rate
        time += [time[-1] + max(turned, SAMPLE_S), time[-1] + max(turned, SAMPLE_S) + 2.0]
        angle += [corner, corner]
    even = np.arange(0.0, time[-1], SAMPLE_S)
    return even, np.interp(even, time, angle)


def _sawtooth(amplitude: float, rate: float) -> Motion:
    """Time and angle of turns to and fro between 0 and an angle, without holds, for ten seconds."""
    time = np.arange(0.0, 10.0, SAMPLE_S)
    turned = rate * np.maximum(time - _REST_S, 0.0)
    return time, amplitude - np.abs(turned % (2 * amplitude) - amplitude)


def _sine(amplitude: float, hertz: float) -> Motion:
    time = np.arange(0.0, 10.0, SAMPLE_S)
    running = np.maximum(time - _REST_S, 0.0)
    return time, amplitude * np.sin(2 * np.pi * hertz * running)


def _trial(time: Array, angle: Array, depth: float, free: float, speed: float) -> PreparedTrial:
    """A trial at constant depth of tissue, in which the shaft slides out of the free length."""
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
