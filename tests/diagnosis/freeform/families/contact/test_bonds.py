"""A free law of bonds that break: where they never do, they are dry friction."""

import numpy as np
import pytest
from diagnosis_fixtures import turns
from free_forms import covered, same_readings

from diagnosis.effects import LIBRARY
from diagnosis.freeform.families.contact.bonds import families
from diagnosis.replay.rig_parameters import NOMINAL

ANGLE, LEVEL = turns(6.0), 0.001
DRY = LIBRARY["coulomb_friction"].apply(NOMINAL, LEVEL)
(BONDS,) = families(covered(ANGLE, tip=ANGLE))


def test_a_base_that_hardly_turns_has_no_such_law():
    assert families(covered(0.001 * ANGLE, tip=ANGLE)) == ()


def test_bonds_that_never_break_are_dry_friction_with_a_twist():
    """The twist adds a thousandth to the presliding of 0.1 deg, which is 2 in 1000 of what is read."""
    assert same_readings(ANGLE, BONDS.effect.apply(NOMINAL, LEVEL, 1e-4, 10.0, 1.0), DRY, within=1e-5)
    assert not same_readings(ANGLE, BONDS.effect.apply(NOMINAL, LEVEL, 1e-4, 10.0, 0.05), DRY)
    assert not same_readings(ANGLE, BONDS.effect.apply(NOMINAL, LEVEL, 40.0, 10.0, 1.0), DRY)
    slip_deg, friction = BONDS.curve(LEVEL, 5.0, 10.0, 0.2)
    np.testing.assert_allclose(friction, LEVEL * (0.2 + 0.8 * np.exp(-slip_deg / 10.0)))
    assert slip_deg[-1] == pytest.approx(60.0)
