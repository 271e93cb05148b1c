"""What the base did before a recording began.

A trial that begins twisted or moving has a past that the log does not show. What it left is the state
of the needle, and a few numbers tell enough of it: the base starts at rest, untwisted, at

    first angle - wound - turned,

turns by `wound`, rests, and turns by `turned` into the first sample, at whose rate it arrives. The same
needle as in the trial goes through this. So what is left of it follows the law of whatever rig is
replayed: viscous tissue has forgotten most of it, dry friction keeps it until a motion tears it away.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicHermiteSpline

from diagnosis.prepare.prepared_log import PreparedTrial
from sim.schedule import Schedule

Array = NDArray[np.float64]

_TURN_S, _REST_S = 1.0, 1.0


@dataclass(frozen=True, kw_only=True)
class Past:
    """How the base came to where a trial begins.

    Attributes:
      trial: its name.
      wound_deg: turn before a rest.
      turned_deg: turn that ends where the log begins.
    """

    trial: str
    wound_deg: float
    turned_deg: float


def schedule_with_past(trial: PreparedTrial, past: Past) -> Schedule:
    """The inputs of a trial with those of its past before them; depth and speed as they are first."""
    logged, rate_deg_s = trial.schedule, trial.start_rate_deg_s
    first_deg = logged.drive[0]
    rested_deg = first_deg - past.turned_deg
    times_s = -np.cumsum([0.0, _TURN_S, _REST_S, _TURN_S])[::-1]
    angles_deg = np.array([rested_deg - past.wound_deg, rested_deg, rested_deg, first_deg])
    motion = CubicHermiteSpline(times_s, angles_deg, np.array([0.0, 0.0, 0.0, rate_deg_s]))
    steps = round(-times_s[0] / trial.sample_s)
    before_s = np.linspace(times_s[0], 0.0, steps + 1)[:-1]

    def with_first(values: Array) -> Array:
        return np.concatenate([np.full(before_s.size, values[0]), values])

    return Schedule(
        time_s=np.concatenate([logged.time_s[0] + before_s, logged.time_s]),
        drive=np.concatenate([motion(before_s), logged.drive]),
        free_mm=with_first(logged.free_mm),
        inserted_mm=with_first(logged.inserted_mm),
        speed_mm_s=with_first(logged.speed_mm_s),
        tip_torque_n_mm=with_first(logged.tip_torque_n_mm),
    )
