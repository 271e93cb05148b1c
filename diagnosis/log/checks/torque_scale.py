"""The size of the torque, compared with the range that the nominal needle and tissue allow.

For a shaft of torsional rigidity kappa = J G with a free length l, in tissue over the length L:

    at most   kappa / l times the twist: the tissue holds everything deeper
    at least  the smaller of kappa / (l + L) times the twist, and damping x rate x L

Real rigs stay near this range: friction adds torque, a soft drive reduces it. A torque far outside is in
another unit, whatever the rig's own scale is. If the tip is not measured, the range of the base's
angle replaces the twist.
"""

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from diagnosis.criteria.checks import (
    LEAST_FREE_SHAFT_MM,
    SCALE_SIGMA,
    TORQUE_OVER_TWIST,
    TORQUE_UNDER_NOMINAL,
    TURN_LEAST_DEG,
)
from diagnosis.log.checks.binned_trial import binned
from diagnosis.log.checks.wording import listed
from diagnosis.log.trial import SENSORS, Trial

Array = NDArray[np.float64]

_UNITS = "angles in rad: multiply by 57.2958; torque in N m: multiply by 1000, in mN mm: divide by 1000"


def torque_warnings(
    trials: Sequence[Trial], noise: Mapping[str, float], rigidity_n_mm2: float, damping: float
) -> list[str]:
    """Warnings about torques of another scale than that of the nominal rig.

    Args:
      noise: claimed standard deviation by column.
      damping: nominal damping, N mm s / rad per mm.
    """
    judged = [trial for trial in trials if trial.has("base_torque_n_mm")]
    passive = [trial for trial in judged if not trial.tip_is_loaded]
    return [
        *_too_much(judged, rigidity_n_mm2),
        *_too_little(passive, noise, rigidity_n_mm2, damping),
    ]


def torque_over_twist(
    base_angle_deg: Array, tip_angle_deg: Array, torque_n_mm: Array, stiffness_n_mm_per_rad: float
) -> float:
    """The largest torque / torque of a spring of that stiffness at the largest twist."""
    twist = np.nanmax(np.abs(np.radians(base_angle_deg - tip_angle_deg)), initial=1e-9)
    return float(np.nanquantile(np.abs(torque_n_mm), 0.99) / (stiffness_n_mm_per_rad * twist))


def stiffest_n_mm_per_rad(trial: Trial, rigidity_n_mm2: float) -> float:
    """Torsional stiffness of the smallest possible free shaft, if tissue holds all the rest."""
    return rigidity_n_mm2 / max(float(trial["free_mm"].min()), LEAST_FREE_SHAFT_MM)


def _too_much(trials: Sequence[Trial], rigidity_n_mm2: float) -> list[str]:
    ratios = {trial.name: _over_stiffest(trial, rigidity_n_mm2) for trial in trials}
    high = {name: ratio for name, ratio in ratios.items() if ratio > TORQUE_OVER_TWIST}
    if not high:
        return []
    worst = max(high, key=lambda name: high[name])
    twisted = all(trial.has("tip_angle_deg") for trial in trials if trial.name in high)
    motion = "from base_angle_deg to tip_angle_deg" if twisted else "by all that base_angle_deg swings"
    return [
        f"{listed(high)}: base_torque_n_mm is up to {high[worst]:.3g} times what twists the nominal "
        f"needle {motion} ({worst}); check units and order of the columns ({_UNITS}), "
        "and diameter_mm and shear_modulus_gpa in rig.yaml"
    ]


def _over_stiffest(trial: Trial, rigidity_n_mm2: float) -> float:
    """Torque / torque of the twist in the smallest possible free shaft."""
    stiffness = stiffest_n_mm_per_rad(trial, rigidity_n_mm2)
    if all(trial.has(sensor) for sensor in SENSORS):
        base, tip = trial["base_angle_deg"], trial["tip_angle_deg"]
        return torque_over_twist(base, tip, trial["base_torque_n_mm"], stiffness)
    turning = binned(trial)
    swing = np.radians(max(np.ptp(turning.base_angle_deg), TURN_LEAST_DEG))
    return float(np.ptp(turning.base_torque_n_mm) / (stiffness * swing))


def _too_little(
    trials: Sequence[Trial], noise: Mapping[str, float], rigidity_n_mm2: float, damping: float
) -> list[str]:
    ratios = {t.name: _over_least(t, noise, rigidity_n_mm2, damping) for t in trials}
    low = {name: ratio for name, ratio in ratios.items() if ratio < TORQUE_UNDER_NOMINAL}
    if not low:
        return []
    worst = min(low, key=lambda name: low[name])
    return [
        f"{listed(low)}: base_torque_n_mm is down to {low[worst]:.2g} times what turns and twists the "
        f"nominal needle as base_angle_deg and time_s say ({worst}); check units of the columns "
        f"({_UNITS}), and the constants in rig.yaml"
    ]


def _over_least(
    trial: Trial, noise: Mapping[str, float], rigidity_n_mm2: float, damping: float
) -> float:
    """Torque / smallest torque for the motion; infinite if that is not far above noise."""
    turning = binned(trial)
    base, tip = turning.base_angle_deg, turning.tip_angle_deg
    inserted, free = float(np.median(trial["inserted_mm"])), float(np.median(trial["free_mm"]))
    twist = np.radians(np.ptp(base - tip if tip.size else base))
    rate = np.quantile(np.abs(np.radians(np.diff(base))), 0.98) / turning.bin_s
    stiffness = rigidity_n_mm2 / max(inserted + free, LEAST_FREE_SHAFT_MM)
    least = float(min(stiffness * twist, damping * rate * inserted))
    if least <= SCALE_SIGMA * noise["base_torque_n_mm"]:
        return float("inf")
    return float(np.ptp(turning.base_torque_n_mm)) / least
