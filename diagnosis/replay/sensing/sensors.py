"""The sensors of a rig: from readings to inputs, and from outputs to readings.

Inputs of the needle follow from the encoder of the drive shaft and the logged depth:

    drive shaft = reading / base_scale,    inserted length = logged + inserted_offset

The sensors of tip and torque show its outputs, with a delay and with separate clocks; that
of the torque may have a low-pass filter (`filters`):

    reading = bias + scale * (tip angle),    reading = bias + scale * (torque at chuck + of bearing)
"""

import math
from collections.abc import Callable, Mapping
from dataclasses import replace
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from diagnosis.criteria.prepare import START_FILTER_DECAYS, START_MOST_UNUSED
from diagnosis.log.trial import BASE, SENSORS, TIP, TORQUE
from diagnosis.replay.interpolation import interpolated
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.replay.sensing.bearing import bearing_torque_n_mm
from diagnosis.replay.sensing.filters import butterworth, first_order, moving_average
from sim.needles.run import SimulationFailed
from sim.schedule import Schedule

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

NEVER: Mapping[str, float] = MappingProxyType({})
"""Clocks that did not run before a trial."""


def driven(
    rig: RigParameters, logged: Schedule, start_s: float = 0.0, torque_n_mm: Array | None = None
) -> Schedule:
    """The inputs of the needle; a tip outside of the tissue has the depth 0.

    Args:
      start_s: start of the trial.
      torque_n_mm: measured torque without its noise, at the times of the schedule; None: not measured.

    Raises:
      SimulationFailed: the needle never reaches the tissue.
    """
    if rig.free is not None:
        torque = np.zeros(logged.time_s.size) if torque_n_mm is None else torque_n_mm
        logged = rig.free.driven(logged, start_s, torque)
    for jump in rig.jumps:
        if jump.sensor == BASE:
            logged = replace(logged, drive=logged.drive - jump.size * (logged.time_s >= jump.time_s))
    if rig.base_scale == 1.0 and rig.inserted_offset_mm == 0.0:
        return logged
    inserted_mm = np.maximum(logged.inserted_mm + rig.inserted_offset_mm, 0.0)
    if not inserted_mm.any():
        raise SimulationFailed(
            f"expected an inserted length above 0 mm, found {logged.inserted_mm.max():.1f} mm logged "
            f"and an offset of {rig.inserted_offset_mm:.1f} mm; take an offset nearer to 0"
        )
    free_mm = np.maximum(logged.free_mm - rig.offset_free_share * rig.inserted_offset_mm, 0.0)
    return replace(logged, drive=logged.drive / rig.base_scale, inserted_mm=inserted_mm, free_mm=free_mm)


def sensed(
    rig: RigParameters,
    inputs: Schedule,
    tip_deg: Array,
    torque_n_mm: Array,
    start_s: float | None = None,
    ran_s: Mapping[str, float] = NEVER,
) -> tuple[Array, Array]:
    """Readings of tip and torque, (N,) each.

    Args:
      inputs: inputs of the needle.
      torque_n_mm: torque on the needle at the chuck.
      start_s: start of the trial; None: that of the inputs, which have no past.
      ran_s: for how long clocks of sensors ran before that, since they agreed; the others agree there.
    """
    time_s, torque = inputs.time_s, torque_n_mm
    start_s = float(time_s[0]) if start_s is None else start_s
    if rig.drive_friction_n_mm != 0.0:
        torque = torque + bearing_torque_n_mm(inputs.drive, rig.drive_friction_n_mm, rig.presliding_deg)
    begun_s = {sensor: start_s - ran_s.get(sensor, 0.0) for sensor in SENSORS}
    tip = _late(interpolated, time_s, tip_deg, begun_s[TIP], rig.tip_clock_ratio, rig.tip_delay_s)
    torque = first_order(time_s, torque, rig.torque_low_pass_s)
    torque = butterworth(time_s, torque, rig.torque_butterworth_s)
    torque = moving_average(time_s, torque, rig.torque_average_s)
    torque = _late(
        np.interp, time_s, torque, begun_s[TORQUE], rig.torque_clock_ratio, rig.torque_delay_s
    )
    tip = rig.tip_bias_deg + rig.tip_scale * tip
    torque = rig.torque_bias_n_mm + rig.torque_scale * torque
    if rig.free is None:
        return tip, torque
    more = rig.free.sensed(inputs, start_s, tip_deg, torque_n_mm)
    return tip + more[0], torque + more[1]


def reads_ahead(
    rig: RigParameters, run_s: Array, at_s: Array, ran_s: Mapping[str, float] = NEVER
) -> dict[str, Mask]:
    """By sensor: samples at which its clock is past the end of the run, where nothing is known, (N,).

    Args:
      run_s: times of the run, which may begin before the trial.
      at_s: times of the samples of the trial.
      ran_s: as for `sensed`.
    """
    clocks = {
        TIP: (rig.tip_clock_ratio, rig.tip_delay_s),
        TORQUE: (rig.torque_clock_ratio, rig.torque_delay_s),
    }
    return {
        sensor: _shown_s(at_s, at_s[0] - ran_s.get(sensor, 0.0), ratio, delay_s) > run_s[-1]
        for sensor, (ratio, delay_s) in clocks.items()
        if ratio > 1.0
    }


def shows_before(rig: RigParameters, at_s: Array) -> Mask:
    """Samples of a trial at which the filter of the torque still shows what was before it, (N,).

    Args:
      at_s: times of the samples.
    """
    constants_s = rig.torque_low_pass_s, math.sqrt(2.0) * rig.torque_butterworth_s
    memory_s = max(START_FILTER_DECAYS * max(constants_s), rig.torque_average_s)
    return np.asarray(at_s - at_s[0] < min(memory_s, START_MOST_UNUSED * float(np.ptp(at_s))))


def _late(
    interpolate: Callable[[Array, Array, Array], Array],
    time_s: Array,
    values: Array,
    start_s: float,
    clock_ratio: float,
    delay_s: float,
) -> Array:
    """Values a delay ago, by a clock that drifts; before the first sample, that sample.

    Args:
      interpolate: as smooth as the values; straight lines where filters assume them, too.
    """
    if clock_ratio == 1.0 and delay_s == 0.0:
        return values
    return interpolate(_shown_s(time_s, start_s, clock_ratio, delay_s), time_s, values)


def _shown_s(time_s: Array, start_s: float, clock_ratio: float, delay_s: float) -> Array:
    """Times of which a sensor shows the values."""
    return start_s + (time_s - start_s) * clock_ratio - delay_s
