"""Columns that a passive needle, driven at its base, cannot have produced together.

The tip follows the base: a lagging copy of the base angle explains it, with a gain
above 0. The drive does work on the needle and gets only part of it back. Wrong
signs and swapped columns violate this grossly. Only gross violations are refused:
friction, play, delays and gains of a real rig are far from them.
"""

from collections.abc import Mapping
from itertools import combinations
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from diagnosis.criteria.checks import (
    BACKWARD_SHARE,
    BACKWARD_TRAVEL_MM,
    DISTINCT_NOISES,
    LARGE_TURN_DEG,
    NEGATIVE_WORK,
    SWAPPED_LEAST,
    SWAPPED_SHARE,
    TORQUE_OVER_TWIST,
    TWIST_CORRELATION,
    UNEXPLAINED_OPPOSITE,
    UNEXPLAINED_SAME,
)
from diagnosis.log.checks.binned_trial import BinnedTrial, binned, misfit
from diagnosis.log.checks.torque_scale import stiffest_n_mm_per_rad, torque_over_twist
from diagnosis.log.checks.travel import travelled_mm
from diagnosis.log.faults.scatter import agrees, scatter
from diagnosis.log.trial import SENSORS, Trial, UnusableLog

Array = NDArray[np.float64]


def refuse_contradictions(
    path: Path, trial: Trial, noise: Mapping[str, float], rigidity_n_mm2: float
) -> None:
    """Refuse a trial with wrong signs or swapped columns.

    Args:
      path: file of the trial, for the message.
      trial: the trial without faulty readings.
      noise: claimed standard deviation by column.
      rigidity_n_mm2: nominal torsional rigidity.

    Raises:
      UnusableLog: names the columns and the fix.
    """
    _refuse_swapped_noise(path, trial, noise)
    _refuse_swapped_lengths(path, trial)
    if trial.tip_is_loaded:
        return  # the tip may be driven as well
    turning = binned(trial)
    if turning.tip_angle_deg.size and turning.base_torque_n_mm.size:
        _refuse_swapped_torque(path, turning, stiffest_n_mm_per_rad(trial, rigidity_n_mm2))
    _refuse_swapped_angles(path, turning)
    _refuse_opposite_angles(path, turning)
    _refuse_negative_work(path, turning)


def _refuse_swapped_noise(path: Path, trial: Trial, noise: Mapping[str, float]) -> None:
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
    return abs(_correlation(base, tip)) > abs(_correlation(other, torque))


def _refuse_swapped_lengths(path: Path, trial: Trial) -> None:
    """Refuse a needle that gets deeper while it is pulled out."""
    travel, deeper = travelled_mm(trial), trial["inserted_mm"] - trial["inserted_mm"][0]
    moved = np.ptp(deeper)
    if moved > BACKWARD_TRAVEL_MM and np.abs(deeper + travel).max() < BACKWARD_SHARE * moved:
        raise UnusableLog(
            f"{path}: inserted_mm changes as speed_mm_s (+ into the tissue) says, but backwards; "
            "expected it to follow or stay; if inserted_mm and free_mm are swapped, swap their names, "
            "else change the sign of speed_mm_s"
        )


def _refuse_swapped_torque(path: Path, turning: BinnedTrial, stiffness_n_mm_per_rad: float) -> None:
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
        if plausible and _correlation(torque, base - tip) > TWIST_CORRELATION:
            _swapped(path, name, "base_torque_n_mm", "only then does the torque follow from the twist")


def _refuse_swapped_angles(path: Path, turning: BinnedTrial) -> None:
    """Refuse a base that follows the tip, with a torque that rises as the tip runs ahead."""
    base, tip, torque = turning.base_angle_deg, turning.tip_angle_deg, turning.base_torque_n_mm
    if not _both_turn(turning) or (torque.size and _correlation(torque, base - tip) > 0):
        return
    forth, back = misfit(base, tip, turning.bin_s)[0], misfit(tip, base, turning.bin_s)[0]
    if forth > SWAPPED_LEAST and back < SWAPPED_SHARE * forth:
        _swapped(path, "base_angle_deg", "tip_angle_deg", "the tip moves first and the base follows")


def _refuse_opposite_angles(path: Path, turning: BinnedTrial) -> None:
    """Refuse a tip that turns against the base, unless the torque follows the twist as it is read.

    In a trial that begins twisted the tip may turn back while the base goes on.
    """
    base, tip, torque = turning.base_angle_deg, turning.tip_angle_deg, turning.base_torque_n_mm
    if not _both_turn(turning):
        return
    if torque.size and _correlation(torque, base - tip) > _correlation(torque, base + tip):
        return
    same, opposite = misfit(base, tip, turning.bin_s)
    if opposite < UNEXPLAINED_OPPOSITE and same > UNEXPLAINED_SAME:
        raise UnusableLog(
            f"{path}: tip_angle_deg turns the opposite way of base_angle_deg; expected the same "
            "positive direction; change the sign of the one that is wrong"
        )


def _refuse_negative_work(path: Path, turning: BinnedTrial) -> None:
    """Refuse work on the needle that is far below zero, with or without an offset of the torque."""
    base, tip, torque = turning.base_angle_deg, turning.tip_angle_deg, turning.base_torque_n_mm
    if torque.size == 0 or np.ptp(base) < LARGE_TURN_DEG:
        return
    if tip.size and _correlation(torque, base - tip) > -TWIST_CORRELATION:
        return
    turned = np.diff(base)
    shares = []
    for offset in (0.0, torque[:3].mean()):
        work = (torque[1:] + torque[:-1] - 2 * offset) * turned
        shares.append(work.sum() / max(np.abs(work).sum(), 1e-300))
    if max(shares) < NEGATIVE_WORK:
        raise UnusableLog(
            f"{path}: base_torque_n_mm works against base_angle_deg, as if the needle drove the drive; "
            "expected a torque into the needle, positive as the angle; change the sign of the one that "
            "is wrong"
        )


def _both_turn(turning: BinnedTrial) -> bool:
    base, tip = turning.base_angle_deg, turning.tip_angle_deg
    return tip.size > 0 and bool(min(np.ptp(base), 2 * np.ptp(tip)) >= LARGE_TURN_DEG)


def _correlation(one: Array, other: Array) -> float:
    if np.ptp(one) == 0 or np.ptp(other) == 0:
        return 0.0
    return float(np.corrcoef(one, other)[0, 1])


def _swapped(path: Path, one: str, other: str, why: str) -> None:
    raise UnusableLog(
        f"{path}: {one} and {other} seem to be swapped: {why}; expected each in the column of its name; "
        "swap the two names in the header"
    )
