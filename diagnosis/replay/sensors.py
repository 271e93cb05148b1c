"""What sensors and constants of a rig make of what it does.

On the way in, the encoder of the drive shaft and the logged depth say what is done to the needle:

    drive shaft = reading / base_scale,    inserted length = logged + inserted_offset

On the way out, the sensors of tip and torque say what it does, a delay ago:

    reading = bias + scale * (tip angle),    reading = bias + scale * (torque at chuck + of bearing)
"""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from diagnosis.replay.bearing import bearing_torque_n_mm
from diagnosis.replay.rig_parameters import RigParameters
from sim.schedule import Schedule
from sim.simulation import SimulationFailed

Array = NDArray[np.float64]


def driven(rig: RigParameters, logged: Schedule) -> Schedule:
    """What is done to the needle; a tip outside of the tissue has the depth 0.

    Raises:
      SimulationFailed: the needle never reaches the tissue.
    """
    if rig.base_scale == 1.0 and rig.inserted_offset_mm == 0.0:
        return logged
    inserted_mm = np.maximum(logged.inserted_mm + rig.inserted_offset_mm, 0.0)
    if not inserted_mm.any():
        raise SimulationFailed(
            f"expected an inserted length above 0 mm, found {logged.inserted_mm.max():.1f} mm logged "
            f"and an offset of {rig.inserted_offset_mm:.1f} mm; take an offset nearer to 0"
        )
    return replace(logged, drive=logged.drive / rig.base_scale, inserted_mm=inserted_mm)


def sensed(
    rig: RigParameters, time_s: Array, drive_deg: Array, tip_deg: Array, torque_n_mm: Array
) -> tuple[Array, Array]:
    """What the sensors show of tip and torque, (N,) each.

    Args:
      drive_deg: angle of the drive shaft.
      torque_n_mm: that the needle takes at the chuck.
    """
    torque = torque_n_mm
    if rig.drive_friction_n_mm != 0.0:
        torque = torque + bearing_torque_n_mm(drive_deg, rig.drive_friction_n_mm)
    return (
        rig.tip_bias_deg + rig.tip_scale * _delayed(time_s, tip_deg, rig.tip_delay_s),
        rig.torque_bias_n_mm + rig.torque_scale * _delayed(time_s, torque, rig.torque_delay_s),
    )


def _delayed(time_s: Array, values: Array, delay_s: float) -> Array:
    """What was, a delay ago; before the first sample, that sample."""
    return values if delay_s == 0.0 else np.interp(time_s - delay_s, time_s, values)
