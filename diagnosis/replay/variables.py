"""The variables that a free law may depend on, from the inputs and outputs of a trial.

time           since the trial began, s
trial_share    the same over the duration of the trial
base_angle     of the drive shaft, deg
rate           at which the drive shaft turns, rad/s
acceleration   of the drive shaft, rad/s^2
direction      in which it last turned: 1 forwards, -1 backwards, straight between over a short time
slid_direction in which dry friction in the drive slides: straight between while it sticks
axial_speed    of the needle into the tissue, mm/s
slid_lately    axial speed either way, mm/s, as a mean over the last seconds (SLID_S)
pushed_lately  axial speed with its sign, mm/s, as the same mean
rested         time since the needle last slid, s; as long as any before it has (RESTED_S)
axial_drag     inserted length, with the sign of the axial speed, mm: what the friction of a needle that
               slides is proportional to; 0 at rest
thrust         inserted length where the needle is pushed, with the sign of slid_direction, mm: what the
               friction of a thrust bearing is proportional to
axial_flow     inserted length times axial speed, mm^2/s: what the viscous drag of a sliding needle is
               proportional to
depth          inserted length, mm
advanced_by    advance since the needle last moved the other way, mm
slid           how far the needle has slid since the start of the trial, into the tissue less back, mm
travelled      the same, in both directions together, mm
history        total angle that the drive shaft has turned so far, in both directions, turns
tip_angle      deg
tip_rate       rad/s
tip_direction  in which the tip last turned, as direction
torque         torque on the needle at the chuck, N mm
torque_rate    N mm / s
past           time constant, s, with which a reading follows what it shows
turned_by      turn since the last reversal, for a reading with hysteresis, in its own unit
lag            of a reading or the needle in its chuck behind what it follows, in its own unit
"""

from collections.abc import Callable, Mapping
from enum import StrEnum
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import cumulative_trapezoid
from scipy.ndimage import uniform_filter1d

from diagnosis.replay.sensing.bearing import stopped_at
from diagnosis.replay.sensing.filters import first_order
from sim.discretisation import PRESLIDING_DEG
from sim.schedule import Schedule

Array = NDArray[np.float64]

STILL_DEG_S = 1.0  # slower than this, a drive shaft rests
_TURN_S = 0.1  # in which a direction changes
_RATE_S = 0.02  # over which rates are taken
_SLIDES_MM_S = 0.1  # axial speed at which friction is no longer that of a needle at rest
RESTED_S = 20.0  # since the needle slid, after which no tissue knows
SLID_S = 4.0  # in which tissue forgets that the needle slid: its relaxation takes some seconds


class Variable(StrEnum):
    """A variable of a free law."""

    TIME = "time"
    TRIAL_SHARE = "trial_share"
    BASE_ANGLE = "base_angle"
    RATE = "rate"
    ACCELERATION = "acceleration"
    DIRECTION = "direction"
    SLID_DIRECTION = "slid_direction"
    AXIAL_SPEED = "axial_speed"
    SLID_LATELY = "slid_lately"
    PUSHED_LATELY = "pushed_lately"
    RESTED = "rested"
    AXIAL_DRAG = "axial_drag"
    THRUST = "thrust"
    AXIAL_FLOW = "axial_flow"
    DEPTH = "depth"
    ADVANCED_BY = "advanced_by"
    SLID = "slid"
    TRAVELLED = "travelled"
    HISTORY = "history"
    TIP_ANGLE = "tip_angle"
    TIP_RATE = "tip_rate"
    TIP_DIRECTION = "tip_direction"
    TORQUE = "torque"
    TORQUE_RATE = "torque_rate"
    PAST = "past"
    TURNED_BY = "turned_by"
    LAG = "lag"


UNITS = {
    Variable.TIME: "s",
    Variable.TRIAL_SHARE: "of the trial",
    Variable.BASE_ANGLE: "deg",
    Variable.RATE: "rad/s",
    Variable.ACCELERATION: "rad/s^2",
    Variable.DIRECTION: "-",
    Variable.SLID_DIRECTION: "-",
    Variable.AXIAL_SPEED: "mm/s",
    Variable.SLID_LATELY: "mm/s",
    Variable.PUSHED_LATELY: "mm/s",
    Variable.RESTED: "s",
    Variable.AXIAL_DRAG: "mm, with the sign of the axial speed",
    Variable.THRUST: "mm, with the sign of the direction",
    Variable.AXIAL_FLOW: "mm^2/s",
    Variable.DEPTH: "mm",
    Variable.ADVANCED_BY: "mm",
    Variable.SLID: "mm",
    Variable.TRAVELLED: "mm",
    Variable.HISTORY: "turns",
    Variable.TIP_ANGLE: "deg",
    Variable.TIP_RATE: "rad/s",
    Variable.TIP_DIRECTION: "-",
    Variable.TORQUE: "N mm",
    Variable.TORQUE_RATE: "N mm / s",
    Variable.PAST: "s",
    Variable.TURNED_BY: "of its unit",
    Variable.LAG: "of its unit",
}
SAYS: Mapping[str, str] = {
    Variable.TRIAL_SHARE: "time",
    Variable.ACCELERATION: "rate",
    Variable.SLID_LATELY: "axial_speed",
    Variable.PUSHED_LATELY: "axial_speed",
    Variable.RESTED: "history",
    Variable.AXIAL_DRAG: "axial_speed",
    Variable.THRUST: "axial_speed",
    Variable.AXIAL_FLOW: "axial_speed",
    Variable.ADVANCED_BY: "axial_speed",
    Variable.SLID: "axial_speed",
    Variable.TRAVELLED: "history",
    Variable.SLID_DIRECTION: "direction",
    Variable.TIP_RATE: "rate",
    Variable.TIP_DIRECTION: "direction",
    Variable.TORQUE_RATE: "history",
    Variable.PAST: "history",
    Variable.TURNED_BY: "history",
    Variable.LAG: "rate",
}
"""What variables are called in the vocabulary, those that have no name of their own there."""
OF_THE_NEEDLE = (
    Variable.TIP_ANGLE,
    Variable.TIP_RATE,
    Variable.TIP_DIRECTION,
    Variable.TORQUE,
    Variable.TORQUE_RATE,
)
"""Variables that are known only once the needle was simulated."""


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
    Variable.HISTORY: _history,
    Variable.SLID: _slid,
    Variable.TRAVELLED: _travelled,
}
"""How each variable follows from the inputs of a trial and its start, s."""
