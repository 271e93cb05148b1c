"""The digital servo of a torque-driven rotor: a PD law, with feed-forward of the needle's torque.

A rotor of inertia J carries the needle; a sensor between the two measures the needle's torque T:
J a = u - T. At every step the servo reads the encoder and sets the motor torque

    u = J (w^2 (command - x) - 2 d w v) + T,

so that the shaft moves as in models.servo, whatever the needle does: the gains follow from
the natural frequency w, the damping ratio d and the rotor's inertia, and T causes no
error. A bias b of the torque sensor does: (10/9 + 4 d / 3) b / (J w^2) at w h << 1, since PD law and
observer both take it for a torque. Angle x and rate v are estimates of an
observer of the rotor, which follows the encoder with two equal poles p = e^(-3 w h):

    e = encoder - x,   x += (1 - p^2) e,   v += (1 - p)^2 e / h

since differences of quantised angles would be mostly quantisation noise. MuJoCo's actuator clips
the torque to the motor's limit; the observer uses the clipped torque.
"""

import math

from models import units
from models.drive import Drive
from models.errors import InvalidValue
from sim.loop.delay_line import DelayLine
from sim.loop.hardware import LoopHardware
from sim.loop.measurement import quantised

_OBSERVER_SPEED = 3.0  # of the observer's poles over the servo's natural frequency


class ServoLoop:
    """The servo of one run; starts at rest at angle 0.

    Raises:
      InvalidValue: the hardware has no servo, the rotor has no inertia, or the step is too
        long for the servo (w h above 0.5).
    """

    def __init__(self, hardware: LoopHardware, drive: Drive, *, step_s: float) -> None:
        if hardware.servo is None:
            raise InvalidValue("hardware.servo", None, "a servo, because drive.kind is torque")
        if drive.rotor_inertia_kg_m2 == 0:
            raise InvalidValue(
                "drive.rotor_inertia_kg_m2", 0.0, "above 0, because a servo turns the rotor"
            )
        w, h = hardware.servo.rate_rad_s, step_s
        if w * h > 0.5:
            raise InvalidValue(
                "step_s", h, f"at most {0.5 / w:.2g} s for this servo", "shorten the step"
            )
        inertia = drive.rotor_inertia_kg_m2 / units.N_MM * units.DEG  # N mm per deg/s^2
        self._inertia, self._limit_n_mm, self._step_s = inertia, drive.torque_limit_n_mm, h
        self._stiffness, self._damping = w**2, 2 * hardware.servo.damping_ratio * w
        pole = math.exp(-_OBSERVER_SPEED * w * h)
        self._angle_gain, self._rate_gain = 1 - pole**2, (1 - pole) ** 2 / h
        self._count_deg = hardware.sensors.base_step_deg
        self._latency = DelayLine(hardware.command_latency_s, h, first=0.0)
        self._angle_deg = self._rate_deg_s = self._acceleration_deg_s2 = 0.0

    def motor_torque_n_mm(
        self, command_deg: float, shaft_deg: float, needle_torque_n_mm: float
    ) -> float:
        """Torque for the next step, from the true shaft angle, which the encoder quantises."""
        self._observe(quantised(shaft_deg, self._count_deg))
        error_deg = self._latency(command_deg) - self._angle_deg
        wanted = self._stiffness * error_deg - self._damping * self._rate_deg_s
        torque = self._inertia * wanted + needle_torque_n_mm
        if self._limit_n_mm is not None:
            torque = min(max(torque, -self._limit_n_mm), self._limit_n_mm)
        self._acceleration_deg_s2 = (torque - needle_torque_n_mm) / self._inertia
        return torque

    def _observe(self, encoder_deg: float) -> None:
        h = self._step_s
        self._angle_deg += h * self._rate_deg_s + 0.5 * h**2 * self._acceleration_deg_s2
        self._rate_deg_s += h * self._acceleration_deg_s2
        missed = encoder_deg - self._angle_deg
        self._angle_deg += self._angle_gain * missed
        self._rate_deg_s += self._rate_gain * missed
