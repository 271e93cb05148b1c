"""The motion of the base before a recording that began late.

A trial that begins twisted or moving has a past that the log does not show. It determines the
initial state of the needle, which two numbers describe well enough once the fast modes have decayed.
From rest, in smooth ramps, the base

    turns by `wound`, rests, and turns by `twist + turned` to the first angle of the log,

where it arrives with the first rate. The twist is from the first readings; the others are fitted.
The past is simulated with the same needle as the trial, so its effect follows the laws of the
replayed rig: in viscous tissue it decays, elastic tissue creeps back, and dry friction
holds it until a motion releases it.
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
    """The inputs of a trial; a late trial is preceded by its past, at the first depth and speed."""
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
