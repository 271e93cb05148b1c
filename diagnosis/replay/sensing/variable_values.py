"""Values of the variables of a free law, from the inputs of a trial and from what its needle does.

Rates are central differences, as a mean over a short time. A direction is the sign of the last rate that
was not that of rest. What lately slid follows the axial speed with one time constant.
"""

from collections.abc import Callable, Mapping
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import cumulative_trapezoid
from scipy.ndimage import uniform_filter1d

from diagnosis.replay.sensing.bearing import stopped_at
from diagnosis.replay.sensing.filters import first_order
from diagnosis.replay.variables import Variable
from sim.discretisation import PRESLIDING_DEG
from sim.schedule import Schedule

Array = NDArray[np.float64]

STILL_DEG_S = 1.0  # slower than this, a drive shaft rests
_TURN_S = 0.1  # in which a direction changes
_RATE_S = 0.02  # over which rates are taken
_SLIDES_MM_S = 0.1  # axial speed at which friction is no longer that of a needle at rest
RESTED_S = 20.0  # since the needle slid, after which no tissue knows
SLID_S = 4.0  # in which tissue forgets that the needle slid: its relaxation takes some seconds


@lru_cache(maxsize=32)  # rig after rig asks for the same
def of_inputs(variable: Variable, inputs: Schedule, start_s: float) -> Array:
    """Values at the times of the inputs, (N,); not to be changed.

    Args:
      start_s: start of the trial; earlier inputs are its past.
    """
    return OF_INPUTS[variable](inputs, start_s)


def of_needle(variable: Variable, time_s: Array, tip_deg: Array, torque_n_mm: Array) -> Array:
    """Values of a variable that is known once the needle has been simulated, (N,)."""
    match variable:
        case Variable.TIP_ANGLE:
            return tip_deg
        case Variable.TIP_RATE:
            return rate_of(np.radians(tip_deg), time_s)
        case Variable.TIP_DIRECTION:
            return _last_direction(np.degrees(rate_of(np.radians(tip_deg), time_s)), time_s)
        case Variable.TORQUE:
            return torque_n_mm
    return rate_of(torque_n_mm, time_s)


def rate_of(values: Array, time_s: Array) -> Array:
    """Rate of change, per s, over a short time, (N,)."""
    return _smooth(np.gradient(values, time_s), time_s, _RATE_S)


def _smooth(values: Array, time_s: Array, over_s: float) -> Array:
    size = max(1, round(over_s / float(np.median(np.diff(time_s)))))
    return np.asarray(uniform_filter1d(values, size, mode="nearest"))


def _base_rate_deg_s(inputs: Schedule) -> Array:
    return rate_of(inputs.drive, inputs.time_s)


def _acceleration(inputs: Schedule, _: float) -> Array:
    return rate_of(np.radians(_base_rate_deg_s(inputs)), inputs.time_s)


def _trial_share(inputs: Schedule, start_s: float) -> Array:
    return np.asarray((inputs.time_s - start_s) / (inputs.time_s[-1] - start_s))


def _direction(inputs: Schedule, _: float) -> Array:
    return _last_direction(_base_rate_deg_s(inputs), inputs.time_s)


def _last_direction(rate: Array, time_s: Array) -> Array:
    """The direction, kept at rest; before the first turn, that of the first turn."""
    turning = np.flatnonzero(np.abs(rate) > STILL_DEG_S)
    if turning.size == 0:
        return np.zeros(rate.size)
    last = turning[np.maximum(np.searchsorted(turning, np.arange(rate.size), side="right") - 1, 0)]
    return _smooth(np.sign(rate[last]), time_s, _TURN_S)


def _slid_direction(inputs: Schedule, _: float) -> Array:
    return stopped_at(inputs.drive, PRESLIDING_DEG) / PRESLIDING_DEG


def _history(inputs: Schedule, _: float) -> Array:
    return np.concatenate([[0.0], np.cumsum(np.abs(np.diff(inputs.drive)))]) / 360.0


def _slid(inputs: Schedule, start_s: float) -> Array:
    return _since_start(inputs.speed_mm_s, inputs, start_s)


def _travelled(inputs: Schedule, start_s: float) -> Array:
    return _since_start(np.abs(inputs.speed_mm_s), inputs, start_s)


def _since_start(per_s: Array, inputs: Schedule, start_s: float) -> Array:
    """Integral of a rate from the start of the trial on, (N,)."""
    whole = np.asarray(cumulative_trapezoid(per_s, inputs.time_s, initial=0), float)
    return np.asarray(whole - np.interp(start_s, inputs.time_s, whole))


def _slid_lately(inputs: Schedule, _: float) -> Array:
    return first_order(inputs.time_s, np.abs(inputs.speed_mm_s), SLID_S)


def _pushed_lately(inputs: Schedule, _: float) -> Array:
    return first_order(inputs.time_s, inputs.speed_mm_s, SLID_S)


def _rested(inputs: Schedule, _: float) -> Array:
    slid_s = np.where(np.abs(inputs.speed_mm_s) > _SLIDES_MM_S, inputs.time_s, -np.inf)
    return np.minimum(inputs.time_s - np.maximum.accumulate(slid_s), RESTED_S)


def _thrust(inputs: Schedule, start_s: float) -> Array:
    return _slid_direction(inputs, start_s) * np.maximum(_axial_drag(inputs, start_s), 0.0)


def _axial_drag(inputs: Schedule, _: float) -> Array:
    return np.asarray(inputs.inserted_mm * np.tanh(inputs.speed_mm_s / _SLIDES_MM_S))


OF_INPUTS: Mapping[Variable, Callable[[Schedule, float], Array]] = {
    Variable.TIME: lambda inputs, start_s: inputs.time_s - start_s,
    Variable.TRIAL_SHARE: _trial_share,
    Variable.BASE_ANGLE: lambda inputs, _: inputs.drive,
    Variable.RATE: lambda inputs, _: np.radians(_base_rate_deg_s(inputs)),
    Variable.ACCELERATION: _acceleration,
    Variable.DIRECTION: _direction,
    Variable.SLID_DIRECTION: _slid_direction,
    Variable.AXIAL_SPEED: lambda inputs, _: inputs.speed_mm_s,
    Variable.SLID_LATELY: _slid_lately,
    Variable.PUSHED_LATELY: _pushed_lately,
    Variable.RESTED: _rested,
    Variable.AXIAL_DRAG: _axial_drag,
    Variable.THRUST: _thrust,
    Variable.AXIAL_FLOW: lambda inputs, _: inputs.inserted_mm * inputs.speed_mm_s,
    Variable.DEPTH: lambda inputs, _: inputs.inserted_mm,
    Variable.FREE: lambda inputs, _: inputs.free_mm,
    Variable.HISTORY: _history,
    Variable.SLID: _slid,
    Variable.TRAVELLED: _travelled,
}
"""How each variable follows from the inputs of a trial and its start, s."""
