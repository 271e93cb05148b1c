"""A set-up refuses lengths that no needle has, and knows what models may be used again for it."""

import math

import pytest

from models.drive import Drive, DriveKind
from models.errors import InvalidValue
from models.needle import NITINOL
from models.tissue import Tissue
from sim.needles.setup import Setup

VISCOUS = Tissue.uniform(viscous_n_mm_s_per_mm=0.01725)


def setup(free=50.0, inserted=150.0, **fields):
    return Setup(needle=NITINOL, tissue=VISCOUS, free_mm=free, inserted_mm=inserted, **fields)


def test_an_angle_servo_is_a_million_times_stiffer_than_the_shaft():
    stiff = setup()
    shaft = NITINOL.rigidity_n_mm2 * 1e-6 / 0.2
    assert stiff.servo_n_m_per_rad == pytest.approx(1e6 * shaft)
    assert setup(drive=Drive(kind=DriveKind.TORQUE)).servo_n_m_per_rad == 0
    assert setup(drive=Drive(stiffness_n_mm_per_rad=5)).servo_n_m_per_rad == pytest.approx(5e-3)


@pytest.mark.parametrize(
    ("free", "inserted", "field"), [(-1, 10, "free_mm"), (5, math.nan, "inserted_mm"), (0, 0, "above 0")]
)
def test_impossible_lengths_are_refused(free, inserted, field):
    with pytest.raises(InvalidValue, match=field):
        setup(free=free, inserted=inserted)


@pytest.mark.parametrize(
    ("other", "same"),
    [
        (setup(free=40.0, inserted=160.0), True),
        (setup(drive=Drive(kind=DriveKind.TORQUE)), False),
        (setup(rows=4), False),
    ],
    ids=["depth", "kind of drive", "rows of the law table"],
)
def test_models_of_the_same_size_differ_in_numbers_alone(other, same):
    assert (other.size == setup().size) is same
