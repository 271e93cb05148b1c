"""A sensor that is dead, or reads otherwise, below a level."""

import numpy as np
import pytest
from free_forms import VOCABULARY, same_readings
from level_logs import ANGLE, RANGES, TORQUE, ranges_with, read

from diagnosis.effects.effect import Place
from diagnosis.freeform.families.sensors.below_level import families
from diagnosis.replay.rig_parameters import NOMINAL

OF_TORQUE, OF_TIP = families(RANGES)


@pytest.mark.parametrize("sign", [-1, 1])
def test_a_sensor_may_be_dead_below_a_level(sign):
    """But for a corner of 0.5 % of the largest value, it reads what is true beyond it."""
    true, shown = sign * np.array([[1, 10, 19, 21, 50, 90], [0, 0, 0, 21, 50, 90]])
    np.testing.assert_allclose(read(OF_TIP, 1.0 * true, 20.0, 0.0, 0.0), shown, atol=1e-9)


def test_what_is_beyond_a_dead_zone_may_be_read_alone():
    true = np.array([-90.0, -50.0, -15.0, 0.0, 15.0, 50.0, 90.0])
    found = read(OF_TIP, true, 20.0, 0.0, -20.0)
    np.testing.assert_allclose(found, [-70, -30, 0, 0, 0, 30, 70], atol=1e-9)


def test_a_level_may_be_as_small_as_one_likes():
    np.testing.assert_allclose(read(OF_TIP, np.array([-1.0, 1.0]), 1e-6, 0.0, 0.0), [-1.0, 1.0])


def test_with_a_gain_of_1_and_no_jump_it_reads_what_is_true():
    for family in (OF_TORQUE, OF_TIP):
        level, gain, jump = family.effect.parameters
        own = family.effect.apply(NOMINAL, level.start[0], gain.neutral, jump.neutral)
        assert same_readings(ANGLE, own, NOMINAL)


def test_the_law_is_one_of_the_sensor_over_what_it_reads():
    assert [f.says for f in (OF_TORQUE, OF_TIP)] == ["torque", "tip_angle"]
    assert {f.place for f in (OF_TORQUE, OF_TIP)} == {Place.SENSOR}
    assert {f.says for f in (OF_TORQUE, OF_TIP)} <= VOCABULARY
    x, y = OF_TIP.curve(50.0, 0.0, 5.0)
    np.testing.assert_allclose(np.interp([-70.0, -40.0, 40.0, 70.0], x, y), [-5, 40, -40, 5])
    assert all(
        p.low <= s <= p.high for f in (OF_TORQUE, OF_TIP) for p in f.effect.parameters for s in p.start
    )


@pytest.mark.parametrize(("gain", "jump"), [(0.0, 0.0), (1.5, 0.1)], ids=["dead", "another range"])
def test_fits_start_where_the_residual_tells_the_level(gain, jump):
    """Levels that are tried are 8 % apart."""
    level = 0.3 * np.abs(TORQUE).max()
    error = np.where(np.abs(TORQUE) <= level, (gain - 1.0) * TORQUE, np.sign(TORQUE) * jump)
    own, _ = families(ranges_with(error))
    found = [p.start[0] for p in own.effect.parameters]
    assert found[0] == pytest.approx(level, rel=0.08)
    assert found[1:] == pytest.approx([gain, jump], abs=0.1)
