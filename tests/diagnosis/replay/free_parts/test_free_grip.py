"""A grip that gives way."""

import pytest

from diagnosis.replay.free_parts.free_grip import FreeGrip, weaker
from models.drive import Drive


def test_as_it_stands_there_is_none():
    assert FreeGrip().of(Drive()) == Drive()
    assert FreeGrip(play_deg=3.0, stiffness_n_mm_per_rad=1.0).of(Drive()) == Drive()


def test_the_drive_has_the_grip():
    drive = FreeGrip(torque_n_mm=0.2, play_deg=3.0, stiffness_n_mm_per_rad=1.0).of(Drive())
    held = (drive.grip_torque_n_mm, drive.grip_play_deg, drive.grip_stiffness_n_mm_per_rad)
    assert held == (0.2, 3.0, 1.0)


def test_half_as_much_slips_at_twice_the_torque_by_half_the_play():
    half = FreeGrip(torque_n_mm=0.2, play_deg=3.0, stiffness_n_mm_per_rad=1.0).times(0.5)
    assert (half.torque_n_mm, half.play_deg, half.stiffness_n_mm_per_rad) == (0.4, 1.5, 2.0)


@pytest.mark.parametrize("limit", [None, 0.2])
def test_none_of_it_is_no_limit(limit):
    assert weaker(limit, 0.0) is None
