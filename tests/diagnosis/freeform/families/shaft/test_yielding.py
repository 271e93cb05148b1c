"""A free law of a shaft that yields: where it never does, it is the nominal one."""

import numpy as np
import pytest
from diagnosis_fixtures import turns
from free_forms import covered, same_readings

from diagnosis.freeform.families.chuck import families as chucks
from diagnosis.freeform.families.shaft.yielding import families
from diagnosis.replay.rig_parameters import NOMINAL

ANGLE = turns(6.0)
RANGES = covered(ANGLE, tip=ANGLE, torque=0.02 * ANGLE, seen=(ANGLE, 0.02 * ANGLE))


def test_without_a_torque_nothing_is_asked_of_the_shaft():
    assert families(covered(ANGLE, tip=ANGLE)) == ()


@pytest.mark.parametrize(("torque_n_mm", "yields"), [(100.0, False), (0.3, True)])
def test_a_shaft_that_yields_beyond_what_it_takes_is_the_nominal_one(torque_n_mm, yields):
    (yielding,) = families(RANGES)
    assert same_readings(ANGLE, yielding.effect.apply(NOMINAL, torque_n_mm, 0.4), NOMINAL) is not yields
    twist, torque = yielding.curve(2.0, 0.25)
    assert np.diff(torque) / np.diff(twist) == pytest.approx([2.0, 0.5])


@pytest.mark.parametrize("torque_n_mm", [0.1, 0.3])
def test_without_hardening_it_would_be_a_needle_that_slips_in_its_chuck(torque_n_mm):
    """It yields where it carries most. Both would read the same, to how stiff the servo of the drive is.

    So it hardens at least a little.
    """
    (yielding,) = families(RANGES)
    slips = {f.name: f for f in chucks(RANGES)}["slip in the chuck over torque"]
    slipping = slips.effect.apply(NOMINAL, torque_n_mm)
    without, least = (
        yielding.effect.apply(NOMINAL, torque_n_mm, q) for q in (0.0, yielding.effect.parameters[1].low)
    )
    assert same_readings(ANGLE, without, slipping, within=1e-5)
    assert not same_readings(ANGLE, least, slipping, within=0.1)
