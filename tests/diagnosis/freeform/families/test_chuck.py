"""The free law of the chuck: a needle that slips beyond a torque."""

from types import SimpleNamespace

import numpy as np
import pytest
from diagnosis_fixtures import turns
from free_forms import covered, same_readings

from diagnosis.freeform.families.chuck import families
from diagnosis.replay.rig_parameters import NOMINAL

ANGLE, MOST_N_MM = turns(6.0), 1.0
(GRIP,) = families(SimpleNamespace(ends={"torque": (-0.7 * MOST_N_MM, MOST_N_MM)}))


def test_a_log_without_a_torque_has_no_chuck():
    assert families(covered(ANGLE, tip=ANGLE)) == ()


@pytest.mark.parametrize(("torque_n_mm", "slips"), [(100.0, False), (0.3, True)])
def test_a_chuck_that_holds_more_than_the_needle_takes_is_the_nominal_one(torque_n_mm, slips):
    assert same_readings(ANGLE, GRIP.effect.apply(NOMINAL, torque_n_mm), NOMINAL) is not slips


def test_the_torque_is_looked_for_below_the_largest():
    (torque,) = GRIP.effect.parameters
    assert all(torque.low < start < MOST_N_MM for start in torque.start)
    assert torque.high > MOST_N_MM
    _, held = GRIP.curve(0.7)
    np.testing.assert_allclose(held, 0.7)
