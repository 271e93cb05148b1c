"""The hardware of a closed loop, between controller and needle.

    command --latency--> servo --> shaft --> needle
    shaft, torque, tip --noise, bias--> quantised --delay--> measurement

The default is ideal: the shaft is at the commanded angle, and sensors have neither noise nor delay.
"""

from models.needle import NonNegative
from models.record import Record
from models.servo import Servo


class Sensors(Record):
    """Resolution and delay of each sensor; white noise is in `MeasurementNoise`."""

    base_step_deg: NonNegative = 0.0
    """Of the encoder, deg per count; 0: continuous."""
    torque_step_n_mm: NonNegative = 0.0
    tip_step_deg: NonNegative = 0.0
    base_delay_s: NonNegative = 0.0
    """Until a controller receives the reading; the servo reads its own encoder at once."""
    torque_delay_s: NonNegative = 0.0
    tip_delay_s: NonNegative = 0.0
    torque_bias_n_mm: float = 0.0
    """Shown at no torque."""


class LoopHardware(Record):
    """Drive and sensors of a loop.

    If the needle is driven by angle, the shaft has the servo's second-order dynamics; if it is
    driven by torque, a digital servo of the same natural frequency turns the rotor
    (`sim.loop.servo_loop`).
    """

    sensors: Sensors = Sensors()
    command_latency_s: NonNegative = 0.0
    """From the controller to the servo."""
    servo: Servo | None = None
    """None: the shaft is at the command one step later."""
