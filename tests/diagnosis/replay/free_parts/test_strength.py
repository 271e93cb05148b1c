"""Parts of a law that are so many times as strong."""

import pytest

from diagnosis.replay.free_parts.strength import raised, stronger, stronger_kerfs
from models.contact import CONTACT_POINTS, ContactCurve, ContactVariable
from models.kerf import Kerf
from models.tissue import Interface


def test_torques_and_the_stiffness_behind_them_are_multiplied():
    law = Interface(
        viscous_n_mm_s_per_mm=0.02,
        orientation_n_mm_per_mm=0.1,
        exponent=0.8,
        stiffness_n_mm_per_rad_per_mm=0.4,
    )
    half = stronger(law, 0.5)
    assert (half.viscous_n_mm_s_per_mm, half.orientation_n_mm_per_mm) == (0.01, 0.05)
    assert half.stiffness_n_mm_per_rad_per_mm == pytest.approx(0.2)
    assert half.exponent == 0.8
    none = stronger(law, 0.0)
    assert none.viscous_n_mm_s_per_mm == 0.0
    assert none.stiffness_n_mm_per_rad_per_mm == 0.4  # in series with no torque


def test_a_kerf_of_no_strength_is_none():
    kerf = Kerf(torque_n_mm=0.2, travel_mm=5.0, backwards=0.3)
    assert stronger_kerfs((kerf,), 2.0) == (kerf.but(torque_n_mm=0.4),)
    assert stronger_kerfs((kerf,), 0.0) == ()


def test_factors_are_raised_to_the_strength():
    curve = ContactCurve(
        over=ContactVariable.SLIP, factors=(4.0,) * CONTACT_POINTS, scale=1.0, last=10.0
    )
    assert raised(curve, 0.5).factors == (2.0,) * CONTACT_POINTS
