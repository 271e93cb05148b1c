"""A sensor, or a needle in its chuck, that follows at a limited rate."""

import numpy as np
import pytest
from diagnosis_fixtures import turns
from free_forms import VOCABULARY, covered, same_readings

from diagnosis.freeform.families.slow import families
from diagnosis.replay.rig_parameters import NOMINAL

ANGLE = turns(6.0)
REST = np.zeros(ANGLE.size)
TORQUE = 0.01 * ANGLE
LIMITED, GAUGE, CHUCK = families(
    covered(ANGLE, tip=ANGLE + 1.0, torque=TORQUE + 0.1, seen=(ANGLE, TORQUE))
)
SLOW = {LIMITED.name: 5.0, GAUGE.name: 0.05, CHUCK.name: 5.0}
"""Rates that these cannot follow a turn with, deg/s and N mm/s."""


def test_of_sensors_those_that_were_read_may_be_slow():
    torque_alone = families(covered(ANGLE, torque=TORQUE + 0.1, seen=(ANGLE, TORQUE)))
    assert [f.name for f in torque_alone] == [GAUGE.name, CHUCK.name]
    tip_alone = families(covered(ANGLE, tip=ANGLE + 1.0, seen=(ANGLE, REST)))
    assert [f.name for f in tip_alone] == [LIMITED.name, CHUCK.name]


@pytest.mark.parametrize("family", [LIMITED, GAUGE, CHUCK], ids=lambda family: family.name)
def test_what_follows_at_once_and_at_any_rate_is_where_it_should_be(family):
    """The lag is the time constant times the rate: 1e-9 s of 100 deg/s."""
    assert same_readings(ANGLE, family.effect.apply(NOMINAL, 1e-9, 1e4), NOMINAL)
    assert not same_readings(ANGLE, family.effect.apply(NOMINAL, 1e-9, SLOW[family.name]), NOMINAL)


def test_the_law_is_told_over_the_lag():
    lag_deg, rate_deg_s = LIMITED.curve(0.1, 50.0)
    np.testing.assert_allclose(lag_deg, (0.0, 5.0, 10.0))
    np.testing.assert_allclose(rate_deg_s, (0.0, 50.0, 50.0))
    assert {LIMITED.says, GAUGE.says, CHUCK.says} <= VOCABULARY
    assert [f.unit for f in (LIMITED, GAUGE, CHUCK)] == ["deg/s", "N mm/s", "deg/s"]
    assert all(
        p.low < s < p.high for f in (LIMITED, GAUGE, CHUCK) for p in f.effect.parameters for s in p.start
    )
