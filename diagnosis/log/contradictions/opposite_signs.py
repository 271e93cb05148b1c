"""Signs that contradict each other: a tip that turns against the base, a needle that drives the drive,
a depth that shrinks as the needle goes in."""

from pathlib import Path

import numpy as np

from diagnosis.criteria.checks import (
    BACKWARD_SHARE,
    BACKWARD_TRAVEL_MM,
    LARGE_TURN_DEG,
    NEGATIVE_WORK,
    TWIST_CORRELATION,
    UNEXPLAINED_OPPOSITE,
    UNEXPLAINED_SAME,
)
from diagnosis.log.checks.binned_trial import BinnedTrial, both_turn, correlation, misfit
from diagnosis.log.checks.travel import travelled_mm
from diagnosis.log.trial import Trial, UnusableLog


def refuse_backward_lengths(path: Path, trial: Trial) -> None:
    """Refuse a needle that gets deeper while it is pulled out."""
    travel, deeper = travelled_mm(trial), trial["inserted_mm"] - trial["inserted_mm"][0]
    moved = np.ptp(deeper)
    if moved > BACKWARD_TRAVEL_MM and np.abs(deeper + travel).max() < BACKWARD_SHARE * moved:
        raise UnusableLog(
            f"{path}: inserted_mm changes as speed_mm_s (+ into the tissue) says, but backwards; "
            "expected it to follow or stay; if inserted_mm and free_mm are swapped, swap their names, "
            "else change the sign of speed_mm_s"
        )


def refuse_opposite_angles(path: Path, turning: BinnedTrial) -> None:
    """Refuse a tip that turns against the base, unless the torque follows the twist as it is read.

    In a trial that begins twisted the tip may turn back while the base goes on.
    """
    base, tip, torque = turning.base_angle_deg, turning.tip_angle_deg, turning.base_torque_n_mm
    if not both_turn(turning):
        return
    if torque.size and correlation(torque, base - tip) > correlation(torque, base + tip):
        return
    same, opposite = misfit(base, tip, turning.bin_s)
    if opposite < UNEXPLAINED_OPPOSITE and same > UNEXPLAINED_SAME:
        raise UnusableLog(
            f"{path}: tip_angle_deg turns the opposite way of base_angle_deg; expected the same "
            "positive direction; change the sign of the one that is wrong"
        )


def refuse_negative_work(path: Path, turning: BinnedTrial) -> None:
    """Refuse work on the needle that is far below zero, with or without an offset of the torque."""
    base, tip, torque = turning.base_angle_deg, turning.tip_angle_deg, turning.base_torque_n_mm
    if torque.size == 0 or np.ptp(base) < LARGE_TURN_DEG:
        return
    if tip.size and correlation(torque, base - tip) > -TWIST_CORRELATION:
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
