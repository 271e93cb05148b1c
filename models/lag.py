"""Steady twist, in closed form: equations (1) and (2)."""

import math

from models.errors import InvalidValue
from models.needle import Needle


def twist_deg(needle: Needle, *, torque_n_mm: float, length_mm: float) -> float:
    """Twist of a free length that carries one torque, deg: equation (1)."""
    return math.degrees(torque_n_mm * length_mm / needle.rigidity_n_mm2)


def shear_modulus_gpa(
    *, diameter_mm: float, torque_n_mm: float, length_mm: float, twist_deg: float
) -> float:
    """G from a twist test, GPa: equation (1) solved for G (Section II-A)."""
    polar_moment_mm4 = math.pi * diameter_mm**4 / 32
    return torque_n_mm * length_mm / (polar_moment_mm4 * math.radians(twist_deg)) * 1e-3


def lag_deg(needle: Needle, *, base_torque_n_mm: float, free_mm: float, inserted_mm: float) -> float:
    """Lag of the tip when friction is spread evenly along the inserted shaft, deg.

    Equation (2): tau / (J G) (l_in + l_out) / 2, where l_in reaches from the base
    to the entry and l_out from the base to the tip.

    Raises:
      InvalidValue: a length is negative.
    """
    for name, value in (("free_mm", free_mm), ("inserted_mm", inserted_mm)):
        if value < 0:
            raise InvalidValue(name, value, "a length of at least 0 mm")
    mean_mm = free_mm + inserted_mm / 2
    return twist_deg(needle, torque_n_mm=base_torque_n_mm, length_mm=mean_mm)


def level_n_mm_per_mm(needle: Needle, *, lag_deg: float, free_mm: float, inserted_mm: float) -> float:
    """Dry friction per mm that holds a given lag, N mm / mm: (2) solved for the friction."""
    torque = math.radians(lag_deg) * needle.rigidity_n_mm2 / (free_mm + inserted_mm / 2)
    return torque / inserted_mm


def steady_lag_deg(
    needle: Needle,
    *,
    damping_n_mm_s_per_mm: float,
    rate_rad_s: float,
    free_mm: float,
    inserted_mm: float,
) -> float:
    """Lag of the tip at a constant rate in viscous tissue, deg: (2) with tau = beta l omega."""
    torque = damping_n_mm_s_per_mm * inserted_mm * rate_rad_s
    return lag_deg(needle, base_torque_n_mm=torque, free_mm=free_mm, inserted_mm=inserted_mm)
