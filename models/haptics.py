"""What a hand at the base feels of a lag, and how much a display would have to amplify it.

Section VI proposes torque feedback: "an amplified version of the torsional stiffness". At rest,
or at a constant rate, friction that is spread evenly along the inserted shaft makes (2) of the lag

    torque = K lag,      K = kappa / (f + l / 2),

whatever the tissue: K is the shaft's own, of its free length f and half of its inserted length l.
The tissue sets how large torque and lag become. A display that feeds back `gain` times K makes a
lag felt once gain K lag exceeds what a hand can tell from nothing, or from the torque that it
holds anyway. The paper states neither that threshold nor a gain: here they are arguments.

While the base turns, its torque runs ahead of (2): it carries the friction of what moves already,
and the tip does not yet. Then K lag is too little for the torque, not too much.
"""

import math

from models.errors import InvalidValue
from models.lag import twist_deg
from models.needle import Needle


def torque_n_mm_per_deg(needle: Needle, *, free_mm: float, inserted_mm: float) -> float:
    """K: base torque per degree of steady lag, N mm / deg; equation (2) read backwards.

    Raises:
      InvalidValue: a length is negative, or both are 0.
    """
    for name, value in (("free_mm", free_mm), ("inserted_mm", inserted_mm)):
        if not (math.isfinite(value) and value >= 0):
            raise InvalidValue(name, value, "a finite length of at least 0 mm")
    mean_mm = free_mm + inserted_mm / 2
    if mean_mm == 0:
        raise InvalidValue("inserted_mm", inserted_mm, "some shaft: free + inserted above 0")
    return 1.0 / twist_deg(needle, torque_n_mm=1.0, length_mm=mean_mm)


def felt_lag_deg(
    needle: Needle, *, threshold_n_mm: float, free_mm: float, inserted_mm: float, gain: float = 1.0
) -> float:
    """The lag from which on the displayed torque exceeds a threshold, deg.

    Args:
      threshold_n_mm: torque that the hand can just tell, N mm.
      gain: of the display; 1: the bare needle in the hand.

    Raises:
      InvalidValue: threshold or gain is not positive, or a length is impossible.
    """
    _positive(threshold_n_mm=threshold_n_mm, gain=gain)
    stiffness = torque_n_mm_per_deg(needle, free_mm=free_mm, inserted_mm=inserted_mm)
    return threshold_n_mm / (gain * stiffness)


def gain_needed(
    needle: Needle, *, threshold_n_mm: float, lag_deg: float, free_mm: float, inserted_mm: float
) -> float:
    """Gain with which a lag is just felt; below 1 the bare needle tells.

    Args:
      threshold_n_mm: torque that the hand can just tell, N mm.
      lag_deg: to be felt, deg.

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
