"""A free law of bristles: where they hardly twist, they are dry friction or stiction."""

import numpy as np
import pytest
from diagnosis_fixtures import turns
from free_forms import covered, same_readings

from diagnosis.effects import LIBRARY
from diagnosis.freeform.families.contact.bristles import families
from diagnosis.replay.rig_parameters import NOMINAL

ANGLE, KINETIC, STRIBECK = turns(6.0), 0.001, 0.3
(BRISTLES,) = families(covered(ANGLE, tip=ANGLE))


def test_a_base_that_hardly_turns_has_no_such_law():
    assert families(covered(0.001 * ANGLE, tip=ANGLE)) == ()


@pytest.mark.parametrize(
    ("excess", "dry"),
    [
        (0.0, LIBRARY["coulomb_friction"].apply(NOMINAL, KINETIC)),
        (0.0005, LIBRARY["stiction"].apply(NOMINAL, KINETIC, KINETIC + 0.0005, STRIBECK)),
    ],
)
def test_bristles_that_hardly_twist_are_the_friction_of_the_library(excess, dry):
    """The twist adds a thousandth to the presliding of 0.1 deg, which is 2 in 1000 of what is read."""
    stiff = BRISTLES.effect.apply(NOMINAL, KINETIC, excess, STRIBECK, 1e-4, 1e-6)
    assert same_readings(ANGLE, stiff, dry, within=1e-5)
    soft = BRISTLES.effect.apply(NOMINAL, KINETIC, excess, STRIBECK, 40.0, 0.05)
    assert not same_readings(ANGLE, soft, dry)


def test_they_are_told_by_the_level_at_which_they_slip():
    angle_deg, level = BRISTLES.curve(KINETIC, 0.0005, STRIBECK, 5.0, 0.05)
    assert np.interp(2.5, angle_deg, level) == pytest.approx(0.5 * 0.0015)
    assert level[-1] == pytest.approx(0.0015)
