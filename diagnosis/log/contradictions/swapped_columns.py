"""Columns that have changed places, by their noise, or by what follows what."""

from collections.abc import Mapping
from itertools import combinations
from pathlib import Path

import numpy as np

from diagnosis.criteria.checks import (
    DISTINCT_NOISES,
    LARGE_TURN_DEG,
    SWAPPED_LEAST,
    SWAPPED_SHARE,
    TORQUE_OVER_TWIST,
    TWIST_CORRELATION,
)
from diagnosis.log.checks.binned_trial import BinnedTrial, binned, both_turn, correlation, misfit
from diagnosis.log.checks.torque_scale import torque_over_twist
from diagnosis.log.faults.scatter import agrees, scatter
from diagnosis.log.trial import SENSORS, Trial, UnusableLog


def refuse_swapped_noise(path: Path, trial: Trial, noise: Mapping[str, float]) -> None:
    """Refuse two columns if each scatters as rig.yaml claims for the other.

    A torque and an angle may do so by chance: the other angle then tells which of them it follows.
    """
    measured = [name for name in ("base_angle_deg", *SENSORS) if trial.has(name) and noise[name] > 0]
    for one, other in combinations(measured, 2):
        if 1 / DISTINCT_NOISES < noise[one] / noise[other] < DISTINCT_NOISES:
            continue
        swapped = agrees(scatter(trial[one]), noise[other]) and agrees(scatter(trial[other]), noise[one])
        if swapped and not _angles_go_together(trial, {one, other}):
            _swapped(path, one, other, "each scatters as rig.yaml claims for the other")


def _angles_go_together(trial: Trial, columns: set[str]) -> bool:
    """Whether tip and base follow each other more closely than one follows the torque.

    Always False if the columns are the two angles, or one of the angles was not measured.
    """
    if "base_torque_n_mm" not in columns or not trial.has("tip_angle_deg"):
        return False
    turning = binned(trial)
    (angle,) = columns - {"base_torque_n_mm"}
    base, tip, torque = turning.base_angle_deg, turning.tip_angle_deg, turning.base_torque_n_mm
    other = base if angle == "tip_angle_deg" else tip
    return abs(correlation(base, tip)) > abs(correlation(other, torque))


def refuse_swapped_torque(path: Path, turning: BinnedTrial, stiffness_n_mm_per_rad: float) -> None:
    """Refuse a torque far beyond that of the twist, if swapping it with an angle makes it plausible."""
    base, tip, torque = turning.base_angle_deg, turning.tip_angle_deg, turning.base_torque_n_mm
    too_much = torque_over_twist(base, tip, torque, stiffness_n_mm_per_rad) > TORQUE_OVER_TWIST
    if not too_much or np.ptp(torque) < LARGE_TURN_DEG:
        return
    orders = {"tip_angle_deg": (base, torque, tip), "base_angle_deg": (torque, tip, base)}
    for name, (base, tip, torque) in orders.items():
        if np.ptp(base) < LARGE_TURN_DEG:
            continue  # angles in radians, not places
        plausible = torque_over_twist(base, tip, torque, stiffness_n_mm_per_rad) < TORQUE_OVER_TWIST / 2
        if plausible and correlation(torque, base - tip) > TWIST_CORRELATION:
            _swapped(path, name, "base_torque_n_mm", "only then does the torque follow from the twist")


def refuse_swapped_angles(path: Path, turning: BinnedTrial) -> None:
    """Refuse a base that follows the tip, with a torque that rises as the tip runs ahead."""
    base, tip, torque = turning.base_angle_deg, turning.tip_angle_deg, turning.base_torque_n_mm
    if not both_turn(turning) or (torque.size and correlation(torque, base - tip) > 0):
        return
    forth, back = misfit(base, tip, turning.bin_s)[0], misfit(tip, base, turning.bin_s)[0]
    if forth > SWAPPED_LEAST and back < SWAPPED_SHARE * forth:
        _swapped(path, "base_angle_deg", "tip_angle_deg", "the tip moves first and the base follows")


def _swapped(path: Path, one: str, other: str, why: str) -> None:
    raise UnusableLog(
        f"{path}: {one} and {other} seem to be swapped: {why}; expected each in the column of its name; "
        "swap the two names in the header"
    )
