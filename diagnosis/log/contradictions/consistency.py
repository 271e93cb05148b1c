"""Columns that a passive needle, driven at its base, cannot have produced together.

The tip follows the base: a lagging copy of the base angle explains it, with a gain
above 0. The drive does work on the needle and gets only part of it back. Wrong
signs and swapped columns violate this grossly. Only gross violations are refused:
friction, play, delays and gains of a real rig are far from them.
"""

from collections.abc import Mapping
from pathlib import Path

from diagnosis.log.checks.binned_trial import binned
from diagnosis.log.checks.torque_scale import stiffest_n_mm_per_rad
from diagnosis.log.contradictions.opposite_signs import (
    refuse_backward_lengths,
    refuse_negative_work,
    refuse_opposite_angles,
)
from diagnosis.log.contradictions.swapped_columns import (
    refuse_swapped_angles,
    refuse_swapped_noise,
    refuse_swapped_torque,
)
from diagnosis.log.trial import Trial


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
    refuse_swapped_noise(path, trial, noise)
    refuse_backward_lengths(path, trial)
    if trial.tip_is_loaded:
        return  # the tip may be driven as well
    turning = binned(trial)
    if turning.tip_angle_deg.size and turning.base_torque_n_mm.size:
        refuse_swapped_torque(path, turning, stiffest_n_mm_per_rad(trial, rigidity_n_mm2))
    refuse_swapped_angles(path, turning)
    refuse_opposite_angles(path, turning)
    refuse_negative_work(path, turning)
