"""The drive shaft of an angle-driven needle: latency, then a servo.

A command is held until the next sample. Without a servo the shaft reaches it at the end of the
step; with one it moves by the servo's exact response. Within a step MuJoCo turns the shaft
from one angle to the other at constant rate.
"""

import numpy as np

from sim.loop.delay_line import DelayLine
from sim.loop.hardware import LoopHardware


class CommandedShaft:
    """The angle of the drive shaft of one run, deg; starts at rest at `start_deg`."""

    def __init__(self, hardware: LoopHardware, *, step_s: float, start_deg: float = 0.0) -> None:
        self._servo, self._step_s = hardware.servo, step_s
        self._latency = DelayLine(hardware.command_latency_s, step_s, first=start_deg)
        self._state = np.array([start_deg, 0.0])

    def follow(self, command_deg: float) -> float:
        """Apply a command; returns the angle of the shaft at the end of the step, deg."""
        received = self._latency(command_deg)
        if self._servo is None:
            return received
        self._state = self._servo.after(self._state, received, self._step_s)
        return float(self._state[0])
