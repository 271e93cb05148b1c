"""A recording that begins late: the rig has moved before, which the log does not show.

The trial is simulated from rest; its first part is cut off, and `time_s` starts at 0 again. Angles
are those of the encoder and not reset to zero.
"""

from dataclasses import replace

import numpy as np
from numpy.random import Generator

from validation.logs.profiles import log_uniform, min_jerk
from validation.logs.roughness.roughness import Array, Roughness
from validation.rig.motion import TrialMotion

MOVING_DEG_S = 5.0
"""A base that turns faster is moving."""


def late_start(rng: Generator) -> Roughness:
    """Trials begin twisted at rest, or in the middle of a motion: all of them or some."""
    moving, share = bool(rng.random() < 0.5), float(rng.choice([0.5, 1.0]))

    def motions(rng: Generator, trials: list[TrialMotion]) -> list[TrialMotion]:
        late = rng.random(len(trials)) < share
        late[int(rng.integers(len(trials)))] = True
        how = _cut_in_motion if moving else _wound_up
        return [how(rng, one) if cut else one for one, cut in zip(trials, late, strict=True)]

    numbers = {"begins": "moving" if moving else "twisted", "share_of_trials": share}
    return Roughness(name="late_start", numbers=numbers, motions=motions)


def _wound_up(rng: Generator, motion: TrialMotion) -> TrialMotion:
    """A turn by 60 to 400 deg before the recording, which begins 0.1 to 1 s after it."""
    by = rng.choice([-1, 1]) * rng.uniform(60, 400)
    duration_s, hold_s = abs(by) / log_uniform(rng, 40, 200), log_uniform(rng, 0.1, 1.0)
    lead = round((duration_s + hold_s) / motion.dt_s / motion.per_sample) * motion.per_sample
    time_s = np.arange(lead) * motion.dt_s
    turn = by * min_jerk(time_s / duration_s)
    load = motion.tip_torque_n_mm
    return replace(
        motion,
        lead=lead,
        base_deg=np.concatenate((turn, by + motion.base_deg)),
        inserted_mm=_held_before(motion.inserted_mm, lead),
        free_mm=_held_before(motion.free_mm, lead),
        speed_mm_s=np.concatenate((np.zeros(lead), motion.speed_mm_s)),
        tip_torque_n_mm=None if load is None else _held_before(load, lead),
    )


def _held_before(values: Array, lead: int) -> Array:
    return np.concatenate((np.full(lead, values[0]), values))


def _cut_in_motion(rng: Generator, motion: TrialMotion) -> TrialMotion:
    """The recording begins within the first third of the trial, at a time when the base moves."""
    rate = np.abs(np.gradient(motion.base_deg, motion.dt_s))
    points = np.arange(0, motion.base_deg.size, motion.per_sample)
    share = points / motion.base_deg.size
    turning = points[(rate[points] > MOVING_DEG_S) & (share > 0.02) & (share < 1 / 3)]
    return replace(motion, lead=int(rng.choice(turning))) if turning.size else _wound_up(rng, motion)
