"""What acts on the needle during a step: drive and torque at the tip, lengths, speed, tissue."""

from typing import NamedTuple

from sim.kernel import memory_map
from sim.kernel.compiled import Array, inlined
from sim.kernel.shaft import Shaft, drive_input, motor_force


class Inputs(NamedTuple):
    """Inputs of one step, SI: of its middle, or from its start (was) to its end (is)."""

    free: float  # length between chuck and tissue, m
    inserted: float  # length in the tissue, m
    speed: float  # axial, m/s
    tissue: float  # factor of what varies in time
    drive_was: float  # angle at which the servo rests, rad, or a torque on the first node, N m
    drive_is: float
    tip_was: float  # torque that resists at the tip, N m
    tip_is: float
    tip_loaded: bool  # whether the tip carries torque


@inlined
def inputs_of(head: Array, law: Array, shaft: Shaft, past: Array, ctrl: Array) -> Inputs:
    """The inputs from those at the start of a step and at its end, (INPUTS,) each."""
    free = head[memory_map.H_FREE_REF] - _middle(past, ctrl, memory_map.U_CARRIAGE)
    tip_was = -motor_force(shaft.tip, past[memory_map.U_TIP])
    tip_is = -motor_force(shaft.tip, ctrl[memory_map.U_TIP])
    tip_loaded = tip_was != 0.0 or tip_is != 0.0
    for r in range(law.shape[0]):
        tip_loaded |= law[r, memory_map.L_POINT] * law[r, memory_map.L_TOP_INSERTED] != 0.0
    return Inputs(
        free,
        _middle(past, ctrl, memory_map.U_INSERTED),
        _middle(past, ctrl, memory_map.U_SPEED),
        1.0 + _middle(past, ctrl, memory_map.U_TISSUE),
        drive_input(shaft, past[memory_map.U_DRIVE]),
        drive_input(shaft, ctrl[memory_map.U_DRIVE]),
        tip_was,
        tip_is,
        tip_loaded,
    )


@inlined
def _middle(past: Array, ctrl: Array, which: int) -> float:
    """An input at the middle of the step: inputs run straight."""
    return 0.5 * (past[which] + ctrl[which])
