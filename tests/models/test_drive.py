"""The drive at the base, and what is refused."""

import pytest

from models.drive import Drive, DriveKind
from models.errors import InvalidValue


@pytest.mark.parametrize(
    ("field", "bad"),
    [
        ("backlash_deg", -1),
        ("stiffness_n_mm_per_rad", 0),
        ("sheath_friction_n_mm_per_mm", -1e-3),
        ("grip_torque_n_mm", 0),
        ("grip_play_deg", 0),
        ("grip_stiffness_n_mm_per_rad", -1),
    ],
)
def test_an_impossible_drive_is_refused_by_the_name_of_its_field(field, bad):
    with pytest.raises(InvalidValue, match=field):
        Drive(**{field: bad})


def test_a_drive_is_a_rigid_servo_unless_it_says_otherwise():
    assert (Drive().kind, Drive().stiffness_n_mm_per_rad) == (DriveKind.ANGLE, None)
    assert Drive(kind="torque").kind is DriveKind.TORQUE


def test_only_a_servo_has_a_chuck_that_slips():
    assert Drive(grip_torque_n_mm=2.0).grip_torque_n_mm == 2.0
    with pytest.raises(InvalidValue, match=r"grip_torque_n_mm.*torque_limit_n_mm"):
        Drive(kind="torque", grip_torque_n_mm=2.0)


@pytest.mark.parametrize("field", ["grip_play_deg", "grip_stiffness_n_mm_per_rad"])
def test_stops_and_springs_are_those_of_a_chuck_that_slips(field):
    assert getattr(Drive(grip_torque_n_mm=1.0, **{field: 5.0}), field) == 5.0
    with pytest.raises(InvalidValue, match=rf"{field}.*does not slip.*grip_torque_n_mm"):
        Drive(**{field: 5.0})


def test_an_unknown_kind_is_answered_with_the_known_ones():
    with pytest.raises(InvalidValue, match=r"kind: expected 'angle' or 'torque', found 'speed'"):
        Drive(kind="speed")


def test_a_rigid_drive_is_no_softer_one_way():
    with pytest.raises(InvalidValue, match="unwinding_ratio"):
        Drive(unwinding_ratio=0.5)
    assert Drive(unwinding_ratio=0.5, stiffness_n_mm_per_rad=3.0).unwinding_ratio == 0.5
