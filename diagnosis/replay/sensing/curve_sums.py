"""What all curves of a free-form law together make of the inputs of a needle and of its readings.

Torques, angles and readings are added, factors multiplied (diagnosis/replay/free_law.py says on what
curves act). A rate is integrated from the start of the schedule.
"""

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import cumulative_trapezoid

from diagnosis.replay.curve import ActsOn, Curve
from diagnosis.replay.sensing.curve_signals import on_gain, on_needle, on_reading
from sim.schedule import Schedule

Array = NDArray[np.float64]

_OF_TIP = (ActsOn.TIP_READING, ActsOn.TIP_COUNTS, ActsOn.TIP_GAIN)
_OF_TISSUE = (ActsOn.TISSUE_ANGLE, ActsOn.TISSUE_SLIP)  # whose turn the tip shows, too
_RATES = (ActsOn.TISSUE_SLIP, ActsOn.TIP_COUNTS)  # of what a reading gains or loses in a trial
_GAINS = (ActsOn.TIP_GAIN, ActsOn.TORQUE_GAIN)
_LEAST_FACTOR = 1e-3

OF_SENSORS = (ActsOn.DRIVE_TORQUE, ActsOn.TORQUE_READING, *_OF_TIP, ActsOn.TORQUE_GAIN)
"""What curves act on that leave the needle as it is."""


def driven_by(curves: Sequence[Curve], inputs: Schedule, start_s: float, torque_n_mm: Array) -> Schedule:
    """The inputs with the curves that act on the needle.

    Args:
      start_s: when the trial starts, which its curves count time from.
      torque_n_mm: at the base, (N,).
    """
    found: dict[ActsOn, list[Array]] = {what: [] for what in ActsOn}
    for curve in curves:
        found[curve.acts_on].append(on_needle(curve, inputs, start_s, torque_n_mm))
    one, none = np.ones(inputs.time_s.size), np.zeros(inputs.time_s.size)

    def total(what: ActsOn) -> Array:
        return sum(found[what], start=none)

    def product(what: ActsOn) -> Array:
        return math.prod(found[what], start=one)

    slip = total(ActsOn.DRIVE_SLIP) + total(ActsOn.TISSUE_SLIP)
    backwards = total(ActsOn.TISSUE_ANGLE) + cumulative_trapezoid(slip, inputs.time_s, initial=0)
    deeper = np.clip(total(ActsOn.INSERTED_LENGTH), -inputs.inserted_mm, inputs.free_mm)
    resists = np.maximum(product(ActsOn.TISSUE) / product(ActsOn.STIFFNESS), _LEAST_FACTOR)
    return replace(
        inputs,
        drive=inputs.drive + total(ActsOn.DRIVE_ANGLE) - backwards,
        tip_torque_n_mm=inputs.tip_torque_n_mm - total(ActsOn.TIP_TORQUE),
        tissue_factor=resists * product(ActsOn.ORIENTATION),
        inserted_mm=inputs.inserted_mm + deeper,
        free_mm=np.maximum(inputs.free_mm - deeper + total(ActsOn.FREE_LENGTH), 0.0),
    )


def readings_by(
    curves: Sequence[Curve], inputs: Schedule, start_s: float, tip_deg: Array, torque_n_mm: Array
) -> tuple[Array, Array]:
    """Terms to add to the readings of tip and torque, (N,) each."""
    read = {True: np.zeros(tip_deg.size), False: np.zeros(torque_n_mm.size)}
    for curve in curves:
        of_tip = curve.acts_on in (*_OF_TIP, *_OF_TISSUE)
        own = tip_deg if of_tip else torque_n_mm
        if curve.acts_on in (ActsOn.STIFFNESS, *_GAINS):
            more = on_gain(curve, inputs, start_s, own)
        elif curve.acts_on in OF_SENSORS:
            more = on_reading(curve, inputs, start_s, own, tip_deg, torque_n_mm)
        elif curve.acts_on in _OF_TISSUE:
            more = on_needle(curve, inputs, start_s, torque_n_mm)
        else:
            continue
        if curve.acts_on in _RATES:
            more = cumulative_trapezoid(more, inputs.time_s, initial=0)
        read[of_tip] = read[of_tip] + more
    return read[True], read[False]
