"""A joint of the drive that turns unevenly: a universal joint, and the work that it passes on."""

import numpy as np
import pytest
from diagnosis_fixtures import turns
from free_forms import covered

from diagnosis.freeform.families.drive_joint import families
from diagnosis.replay.rig_parameters import NOMINAL
from diagnosis.replay.variables import Variable

ANGLE = turns(6.0)
SEEN = (ANGLE, 0.02 * ANGLE)
(FAMILY,) = families(covered(ANGLE, torque=0.03 * ANGLE, tip=ANGLE, seen=SEEN))
AT_DEG = np.linspace(-400.0, 400.0, 1601)


def curves(*c):
    found = FAMILY.effect.apply(NOMINAL, *c).free.curves
    assert {one.variable for one in found} == {Variable.BASE_ANGLE}
    return {one.acts_on: one.at(AT_DEG) for one in found}


def test_it_needs_the_torque_and_a_base_that_turns():
    assert families(covered(ANGLE, tip=ANGLE, seen=SEEN)) == ()
    assert families(covered(0.0 * ANGLE, torque=0.03 * ANGLE, seen=SEEN)) == ()


def test_a_universal_joint_is_one():
    """tan(needle) = tan(angle) / cos(bend): 15 deg of bend turn it by 1 deg to and fro, twice a turn."""
    bend = np.radians(15.0)
    angle = np.radians(AT_DEG)
    exact = np.degrees(np.arctan2(np.sin(angle), np.cos(bend) * np.cos(angle)) - angle)
    exact = (exact + 180.0) % 360.0 - 180.0
    wave = np.degrees(np.tan(bend / 2) ** 2)
    turned = curves(0.0, 0.0, wave, 0.0)["drive_angle"]
    np.testing.assert_allclose(turned, exact, atol=np.degrees(np.tan(bend / 2) ** 4))


@pytest.mark.parametrize("c", [(0.7, 0.0, 0.0, 0.0), (0.0, 0.4, 1.1, -0.8)])
def test_no_power_is_lost(c):
    """The ratio of torques is that of rates; both splines are off by 1e-4 of the largest wave."""
    found = curves(*c)
    rate_ratio = 1.0 + np.gradient(found["drive_angle"], AT_DEG)
    inner = slice(2, -2)
    np.testing.assert_allclose(found["torque_gain"][inner], rate_ratio[inner], atol=2e-4)


def test_the_curve_that_is_told_is_the_error_of_the_angle():
    c = (0.3, -0.2, 0.5, 0.1)
    at, error = map(np.asarray, FAMILY.curve(*c))
    np.testing.assert_allclose(np.interp(at, AT_DEG, curves(*c)["drive_angle"]), error, atol=1e-3)
    assert error[0] == 0.0
