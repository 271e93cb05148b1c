"""What the base did before a recording began that began late.

A trial that begins twisted or moving has a past that the log does not show. What that left is the
state of the needle, and two numbers tell enough of it, once the fast modes have faded. From rest, in
smooth ramps, the base

    turns by `wound`, rests, and turns by `twist + turned` into the first angle of the log,

where it arrives at the first rate. The twist is that of the first readings; the others are fitted.
The same needle goes through this as through the trial, so that what is left of it follows the law
of whatever rig is replayed: in viscous tissue it fades, elastic tissue creeps back, and dry friction
keeps it until a motion tears it away.
"""

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicHermiteSpline

from diagnosis.prepare.prepared_log import PreparedTrial
from diagnosis.replay.rig_parameters import RigParameters
from sim.schedule import Schedule

Array = NDArray[np.float64]

_TURN_S, _REST_S = 1.0, 2.0
_COLUMNS = ("free_mm", "inserted_mm", "speed_mm_s", "tip_torque_n_mm")


def schedule_with_past(rig: RigParameters, trial: PreparedTrial) -> Schedule:
    """The inputs of a trial; before those of a late one the base turns, at its first depth and speed."""
    start, logged = trial.late_start, trial.schedule
    if start is None:
        return logged
    past = rig.past_of(trial.name)
    first_deg = float(logged.drive[0])
    rest_deg = first_deg - start.twist_deg - past.turned_deg
    angles_deg = [rest_deg - past.wound_deg, rest_deg, rest_deg, first_deg]
    times_s = np.cumsum([0.0, _TURN_S, _REST_S, _TURN_S]) - (2 * _TURN_S + _REST_S)
    motion = CubicHermiteSpline(times_s, angles_deg, [0.0, 0.0, 0.0, start.rate_deg_s])
    before_s = np.linspace(times_s[0], 0.0, round(-times_s[0] / trial.sample_s) + 1)[:-1]

    def with_first(values: Array) -> Array:
        return np.concatenate([np.full(before_s.size, values[0]), values])

    return Schedule(
        time_s=np.concatenate([logged.time_s[0] + before_s, logged.time_s]),
        drive=np.concatenate([motion(before_s), logged.drive]),
        **{column: with_first(getattr(logged, column)) for column in _COLUMNS},
    )
