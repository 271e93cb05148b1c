"""The share of inertia in the base torque, and the smooth motion of the base that it needs.

The base torque has a share J alpha, with J the inertia of shaft, drive and load at the tip. For
a thin needle it is 1e-5 of the noise. If it matters, alpha is the second derivative of a sampled
angle: straight lines between samples would give spikes, so the motion is
interpolated by a cubic spline; and if the sampling rate is too low for it, there is a warning.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

from diagnosis.criteria.log import FEWEST_ROWS
from diagnosis.criteria.prepare import INERTIA_COUNTS_SIGMA, INERTIA_LOST_SIGMA
from diagnosis.log.nominal_rig import NominalRig
from models.needle import Needle

Array = NDArray[np.float64]

_TO_N_MM = 1e3  # from N m
_FINER = 4  # points between two samples, so that a step of half a sample finds points of its own


@dataclass(frozen=True, kw_only=True)
class InertiaTorque:
    """The share of inertia in the base torque of one trial, in units of the torque's noise.

    Attributes:
      rms_sigma: its root mean square.
      lost_sigma: its change if every other sample is left out.
    """

    rms_sigma: float = 0.0
    lost_sigma: float = 0.0

    @property
    def counts(self) -> bool:
        """Whether the motion has to be interpolated smoothly."""
        return self.rms_sigma > INERTIA_COUNTS_SIGMA


def inertia_torque(
    rig: NominalRig, time_s: Array, base_deg: Array, length_mm: float, sigma_n_mm: float
) -> InertiaTorque:
    """The size of the torque of inertia, and how well the samples resolve it.

    Args:
      base_deg: motion of the base without its encoder's noise, (N,).
      length_mm: length of the shaft between chuck and tip.
      sigma_n_mm: noise of the base torque.
    """
    if sigma_n_mm <= 0 or time_s.size < FEWEST_ROWS:
        return InertiaTorque()
    inertia = total_inertia_kg_m2(rig, length_mm)
    alpha = _acceleration_rad_s2(time_s, base_deg)
    thinned = np.interp(time_s, time_s[::2], _acceleration_rad_s2(time_s[::2], base_deg[::2]))
    scale = _TO_N_MM * inertia / sigma_n_mm
    return InertiaTorque(rms_sigma=scale * _rms(alpha), lost_sigma=scale * _rms(thinned - alpha))


def total_inertia_kg_m2(rig: NominalRig, length_mm: float) -> float:
    """Inertia of shaft, drive and tip."""
    shaft = Needle(**dict(rig.needle)).rotary_inertia_kg_m * length_mm * 1e-3
    return float(shaft + rig.inertia.base_kg_m2 + rig.inertia.tip_kg_m2)


def smooth_motion(time_s: Array, base_deg: Array) -> tuple[Array, Array]:
    """The motion at more times, by a cubic spline: times and angles."""
    parts = [time_s[:-1] + (k / _FINER) * np.diff(time_s) for k in range(_FINER)]
    finer = np.append(np.stack(parts, axis=1).ravel(), time_s[-1])
    return finer, np.asarray(CubicSpline(time_s, base_deg)(finer))


def inertia_warning(name: str, torque: InertiaTorque) -> str:
    """Warning if the sampling rate is too low for the torque of inertia; empty if it is not."""
    if not torque.counts or torque.lost_sigma <= INERTIA_LOST_SIGMA:
        return ""
    return (
        f"{name}: the torque of inertia is {torque.rms_sigma:.1f} sigma, but the samples "
        f"of base_angle_deg resolve it only to {torque.lost_sigma:.1f} sigma; log faster, or "
        "turn more slowly"
    )


def _acceleration_rad_s2(time_s: Array, base_deg: Array) -> Array:
    rate = np.gradient(np.radians(base_deg), time_s)
    return np.asarray(np.gradient(rate, time_s))


def _rms(values: Array) -> float:
    return float(np.sqrt(np.mean(values**2)))
