"""What the callback adds to MuJoCo's passive torques, part by part."""

from dataclasses import dataclass

import mujoco
import numpy as np
from numpy.typing import NDArray

from sim.kernel import memory_map

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class PassiveTorques:
    """What the callback added to `qfrc_passive` in the last step, N m, (n + 1,) hinges each.

    Attributes:
      tissue: torque of the tissue on the shaft; the mean over the step for second order.
      other: torques that the model's joints cannot represent: play of the drive, an element whose
        length changes, springs of siblings; 0 without them.
      correction: makes MuJoCo's first-order step one of second order; 0 for a step of order 1.
    """

    tissue: Array
    other: Array
    correction: Array


def passive_torques(model: mujoco.MjModel, data: mujoco.MjData) -> PassiveTorques:
    """The separate torques of the last `mj_step` or `mj_forward`."""
    head = model.numeric("needle").data
    n, rows = int(head[memory_map.H_ELEMENTS]), int(head[memory_map.H_ROWS])
    at = memory_map.CLOCK + 2 * memory_map.block(n, rows)
    torques = data.userdata[at : at + memory_map.torques(n)].reshape(memory_map.TORQUES, n + 1).copy()
    return PassiveTorques(
        tissue=torques[memory_map.T_TISSUE],
        other=torques[memory_map.T_OTHER],
        correction=torques[memory_map.T_CORRECTION],
    )
