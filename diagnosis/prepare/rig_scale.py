"""The size of a rig, which scales bounds and starts of effects.

The library is written for needles like the paper's. The same rig with all torques c times as large
(shear modulus, damping, torque sensor) is the same physics, and has to get the same answer: every
parameter with a unit of torque is multiplied by

    torque = kappa / kappa of the paper's needle,   within limits from the measured torque,

which scales in the same way. Rates are scaled if the base turns faster than needles usually do.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from diagnosis.criteria.prepare import FASTEST_NEEDLE_RAD_S, TORQUES_OF_UNIT_SCALE_N_MM
from diagnosis.prepare.prepared_log import PreparedLog
from models.needle import NITINOL

Array = NDArray[np.float64]

_ALL_BUT = 0.005  # of the readings at either end are not looked at: outliers


@dataclass(frozen=True, kw_only=True)
class RigScale:
    """Factors on the library's bounds and starts.

    Attributes:
      torque_scale: for parameters with a unit of torque.
      rate_scale: for rates of turning.
      dry_n_mm_per_mm: dry torque per mm that would hold the whole measured torque.
      shallowest_mm: depth that every trial reaches.
    """

    torque_scale: float = 1.0
    rate_scale: float = 1.0
    dry_n_mm_per_mm: float = 0.0
    shallowest_mm: float = math.inf


def scale_of(log: PreparedLog) -> RigScale:
    """The size of a rig by its nominal constants and its measured torque and rates."""
    stiffness = log.rig.rigidity_n_mm2 / NITINOL.rigidity_n_mm2
    torques = [t.readings["base_torque_n_mm"] for t in log.trials if t.has("base_torque_n_mm")]
    rates = [np.gradient(np.radians(t.base_motion_deg), t.time_s) for t in log.trials]
    shallowest_mm = float(min(t.inserted_mm.max() for t in log.trials))
    rate = max(1.0, _half_range(rates) / FASTEST_NEEDLE_RAD_S)
    if not torques or _half_range(torques) == 0.0:
        return RigScale(torque_scale=stiffness, rate_scale=rate, shallowest_mm=shallowest_mm)
    most = _half_range(torques)
    least_scale, most_scale = (most / at for at in reversed(TORQUES_OF_UNIT_SCALE_N_MM))
    depth = np.median(np.concatenate([t.inserted_mm for t in log.trials]))
    return RigScale(
        torque_scale=float(np.clip(stiffness, least_scale, most_scale)),
        rate_scale=rate,
        dry_n_mm_per_mm=float(most / depth) if depth > 0 else 0.0,
        shallowest_mm=shallowest_mm,
    )


def _half_range(columns: list[Array]) -> float:
    values = np.concatenate(columns)
    values = values[np.isfinite(values)]
    if values.size == 0:
        return 0.0
    low, high = np.quantile(values, [_ALL_BUT, 1 - _ALL_BUT])
    return float(high - low) / 2
