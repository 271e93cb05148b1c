"""The signals that curves of a free law add to the inputs of the needle, and to readings of sensors.

Each is the curve at its variable, or what hysteresis, creep, a limited rate, a filter or a reading
that is held make of it, times its factor if it has one.
"""

import numpy as np
from numpy.typing import NDArray

from diagnosis.replay.curve import ActsOn, Curve
from diagnosis.replay.sensing.variable_values import of_inputs, of_needle
from diagnosis.replay.variables import OF_THE_NEEDLE, Variable
from sim.schedule import Schedule

Array = NDArray[np.float64]


def on_needle(curve: Curve, inputs: Schedule, start_s: float, torque_n_mm: Array) -> Array:
    """What a curve does to an input of the needle, (N,).

    Args:
      start_s: start of the trial; earlier inputs are its past.
      torque_n_mm: measured torque without its noise, since that of the simulation is not yet known.
    """
    return _before_its_factor(curve, inputs, start_s, torque_n_mm) * _factor(curve, inputs, start_s)


def _before_its_factor(curve: Curve, inputs: Schedule, start_s: float, torque_n_mm: Array) -> Array:
    match curve.variable:
        case Variable.TURNED_BY:
            return curve.with_hysteresis(inputs.drive)
        case Variable.ADVANCED_BY:
            return curve.with_hysteresis(inputs.inserted_mm)
        case Variable.LAG:
            return curve.behind(inputs.time_s, inputs.drive)
        case Variable.PAST:
            return curve.creep(inputs.time_s, torque_n_mm)
        case Variable.TORQUE:
            return curve.at(torque_n_mm)
    return curve.at(of_inputs(curve.variable, inputs, start_s))


def on_reading(
    curve: Curve, inputs: Schedule, start_s: float, read: Array, tip_deg: Array, torque_n_mm: Array
) -> Array:
    """What a curve adds to the reading of a sensor, (N,).

    Args:
      read: what the sensor reads without it, tip or torque.
      tip_deg, torque_n_mm: of the simulated needle.
    """
    factor = _factor(curve, inputs, start_s)
    match curve.variable:
        case Variable.PAST:
            return curve.of_past(inputs.time_s, read) * factor
        case Variable.LAG:
            return curve.behind(inputs.time_s, read) * factor
        case Variable.HELD_BY:
            return curve.held(read) * factor
        case Variable.TURNED_BY:
            turned = inputs.drive if curve.acts_on is ActsOn.DRIVE_TORQUE else read
            return curve.with_hysteresis(turned) * factor
        case variable if variable in OF_THE_NEEDLE:
            return curve.at(of_needle(variable, inputs.time_s, tip_deg, torque_n_mm)) * factor
    return curve.at(of_inputs(curve.variable, inputs, start_s)) * factor


def on_gain(curve: Curve, inputs: Schedule, start_s: float, read: Array) -> Array:
    """What a curve that multiplies a reading adds to it, (N,)."""
    return read * (curve.at(of_inputs(curve.variable, inputs, start_s)) - 1.0)


def _factor(curve: Curve, inputs: Schedule, start_s: float) -> Array:
    if curve.factor is None:
        return np.ones(1)
    return curve.factor.at(of_inputs(curve.factor.variable, inputs, start_s))
