"""A coupling of a free-form law in a drive."""

import pytest

from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.free_parts.free_coupling import FreeCoupling
from models.drive import Drive

HELICAL = FreeCoupling(stiffness_n_mm_per_rad=12.0, unwinding_ratio=0.25)


def test_a_rigid_drive_gets_its_spring():
    drive = FreeLaw(coupling=HELICAL).drive(Drive())
    assert (drive.stiffness_n_mm_per_rad, drive.unwinding_ratio) == (12.0, 0.25)


def test_beside_another_spring_it_is_in_series_either_way():
    drive = HELICAL.of(Drive(stiffness_n_mm_per_rad=6.0))
    assert drive.stiffness_n_mm_per_rad == pytest.approx(4.0)
    assert drive.stiffness_n_mm_per_rad * drive.unwinding_ratio == pytest.approx(2.0)


def test_none_leaves_the_drive_as_it_is():
    drive = Drive(stiffness_n_mm_per_rad=6.0)
    assert FreeCoupling().of(drive) is drive
    assert HELICAL.times(0.0).of(drive) is drive


def test_one_that_gives_way_twice_as_far_is_half_as_stiff():
    assert HELICAL.times(2.0) == FreeCoupling(stiffness_n_mm_per_rad=6.0, unwinding_ratio=0.25)
