"""A tip in the kerf that it has cut: the torque that is told, and the law that acts."""

import math

import numpy as np
import pytest
from diagnosis_fixtures import turns
from free_forms import covered

from diagnosis.freeform.families.in_one_place.kerf import families
from diagnosis.replay.rig_parameters import NOMINAL

ANGLE = turns(6.0)
MOST, ANGLE_DEG, TRAVEL_MM = 0.2, 12.0, 5.0
SLIDING = covered(ANGLE, tip=ANGLE, speed=3.0)


def applied(family, *values):
    (kerf,) = family.effect.apply(NOMINAL, *values).free.kerfs
    return kerf


def test_a_base_that_hardly_turns_has_no_such_law():
    assert families(covered(0.001 * ANGLE, tip=ANGLE)) == ()


def test_a_needle_that_never_slides_stays_in_one_kerf():
    bevel, bent = families(covered(ANGLE, tip=ANGLE))
    assert [p.name for p in bevel.effect.parameters] == ["torque", "angle"]
    assert [p.name for p in bent.effect.parameters] == ["torque"]
    for kerf in (applied(bevel, MOST, ANGLE_DEG), applied(bent, MOST)):
        assert kerf.travel_mm > 1e5  # of the farthest that needles go


def test_one_that_slides_cuts_another_kerf_on_the_way_back_in_part():
    bevel, bent = families(SLIDING)
    for kerf in (
        applied(bevel, MOST, ANGLE_DEG, TRAVEL_MM, 0.3),
        applied(bent, MOST, TRAVEL_MM, 0.3),
    ):
        assert (kerf.torque_n_mm, kerf.travel_mm, kerf.backwards) == (MOST, TRAVEL_MM, 0.3)


@pytest.mark.parametrize("angle_deg", [6.0, 12.0, 40.0])
def test_the_torque_that_is_told_is_that_of_the_law(angle_deg):
    bevel, bent = families(SLIDING)
    at, told = bevel.curve(MOST, ANGLE_DEG, TRAVEL_MM, 1.0)
    assert applied(bevel, MOST, ANGLE_DEG, TRAVEL_MM, 1.0).angle_deg == ANGLE_DEG
    assert np.interp(angle_deg, at, told) == pytest.approx(
        MOST * math.tanh(angle_deg / ANGLE_DEG), rel=0.01
    )
    at, told = bent.curve(MOST, TRAVEL_MM, 1.0)
    assert applied(bent, MOST, TRAVEL_MM, 1.0).angle_deg is None
    assert np.interp(angle_deg, at, told) == pytest.approx(
        MOST * math.sin(math.radians(angle_deg)), rel=0.01
    )
