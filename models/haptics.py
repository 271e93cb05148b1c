"""The torque of a lag as a hand at the base feels it, and the amplification that a display needs.

Section VI proposes torque feedback: "an amplified version of the torsional stiffness". At rest,
or at a constant rate, friction that is spread evenly along the inserted shaft makes (2) of the lag

    torque = K lag,      K = kappa / (f + l / 2),

whatever the tissue: K is the stiffness of the free length f and half of the inserted length l.
The tissue decides how large torque and lag become. With a display that feeds back `gain` times K, a
lag is felt once gain K lag exceeds the smallest torque, or change of torque, that a hand notices.
The paper states neither that threshold nor a gain: here they are arguments.

While the base turns, its torque is larger than (2) says: part of the shaft already slips, and the tip
does not move yet. Then K lag is less than the torque, not more.
"""

import math

from models.errors import InvalidValue
from models.lag import twist_deg
from models.needle import Needle


def torque_n_mm_per_deg(needle: Needle, *, free_mm: float, inserted_mm: float) -> float:
    """K: base torque per degree of steady lag, N mm / deg; equation (2) solved for the torque.

    Raises:
      InvalidValue: a length is negative, or both are 0.
    """
    for name, value in (("free_mm", free_mm), ("inserted_mm", inserted_mm)):
        if not (math.isfinite(value) and value >= 0):
            raise InvalidValue(name, value, "a finite length of at least 0 mm")
    mean_mm = free_mm + inserted_mm / 2
    if mean_mm == 0:
        raise InvalidValue(
            "inserted_mm", inserted_mm, "a length for which free_mm + inserted_mm is above 0"
        )
    return 1.0 / twist_deg(needle, torque_n_mm=1.0, length_mm=mean_mm)


def felt_lag_deg(
    needle: Needle, *, threshold_n_mm: float, free_mm: float, inserted_mm: float, gain: float = 1.0
) -> float:
    """The smallest lag whose displayed torque exceeds a threshold, deg.

    Args:
      threshold_n_mm: smallest torque that the hand notices, N mm.
      gain: gain of the display; 1: the hand holds the needle itself.

    Raises:
      InvalidValue: threshold or gain is not positive, or a length is impossible.
    """
    _positive(threshold_n_mm=threshold_n_mm, gain=gain)
    stiffness = torque_n_mm_per_deg(needle, free_mm=free_mm, inserted_mm=inserted_mm)
    return threshold_n_mm / (gain * stiffness)


def gain_needed(
    needle: Needle, *, threshold_n_mm: float, lag_deg: float, free_mm: float, inserted_mm: float
) -> float:
    """Gain with which a lag is just felt; below 1 no display is needed.

    Args:
      threshold_n_mm: smallest torque that the hand notices, N mm.
      lag_deg: lag that is to be felt, deg.

    Raises:
      InvalidValue: threshold or lag is not positive, or a length is impossible.
    """
    _positive(threshold_n_mm=threshold_n_mm, lag_deg=lag_deg)
    stiffness = torque_n_mm_per_deg(needle, free_mm=free_mm, inserted_mm=inserted_mm)
    return threshold_n_mm / (stiffness * lag_deg)


def _positive(**values: float) -> None:
    for name, value in values.items():
        if not (math.isfinite(value) and value > 0):
            raise InvalidValue(name, value, "a finite number above 0")
