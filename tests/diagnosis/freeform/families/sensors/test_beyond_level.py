"""A sensor that clips, or reads otherwise beyond a level."""

import numpy as np
import pytest
from free_forms import VOCABULARY, same_readings
from level_logs import ANGLE, OF_TIP_ALONE, RANGES, TORQUE, ranges_with, read

from diagnosis.effects.effect import Place
from diagnosis.freeform.families.sensors.beyond_level import families
from diagnosis.replay.rig_parameters import NOMINAL

OF_TORQUE, OF_TIP = families(RANGES)


@pytest.mark.parametrize(("family", "size"), [(OF_TORQUE, 0.01), (OF_TIP, 1.0)], ids=["torque", "tip"])
def test_a_sensor_that_clips_reads_no_more_than_its_level(family, size):
    """But for a corner of 0.5 % of the largest value."""
    true = np.linspace(-90, 90, 181) * size
    np.testing.assert_allclose(
        read(family, true, 50 * size, 0.0, 0.0), np.clip(true, -50 * size, 50 * size), atol=0.5 * size
    )


def test_beyond_the_level_it_may_have_another_gain_and_jump():
    true = np.array([-80.0, -60.0, -40.0, 0.0, 40.0, 60.0, 80.0])
    found = read(OF_TIP, true, 50.0, 1.5, 4.0)
    np.testing.assert_allclose(found, [-99, -69, -40, 0, 40, 69, 99], atol=0.2)


def test_with_a_gain_of_1_and_no_jump_it_reads_what_is_true():
    for family in (OF_TORQUE, OF_TIP):
        _, gain, jump = family.effect.parameters
        level = family.effect.parameters[0].start[1]
        own = family.effect.apply(NOMINAL, level, gain.neutral, jump.neutral)
        assert same_readings(ANGLE, own, NOMINAL)


def test_the_law_is_one_of_the_sensor_over_what_it_reads():
    assert [f.says for f in (OF_TORQUE, OF_TIP)] == ["torque", "tip_angle"]
    assert {f.place for f in (OF_TORQUE, OF_TIP)} == {Place.SENSOR}
    assert {f.says for f in (OF_TORQUE, OF_TIP)} <= VOCABULARY
    x, y = OF_TIP.curve(50.0, 0.0, 0.0)
    assert np.interp(70.0, x, y) == pytest.approx(-20.0, abs=0.1)
    assert all(
        p.low <= s <= p.high for f in (OF_TORQUE, OF_TIP) for p in f.effect.parameters for s in p.start
    )


def test_a_sensor_that_was_not_read_has_none():
    (only,) = families(OF_TIP_ALONE)
    assert only.name == OF_TIP.name


@pytest.mark.parametrize(("gain", "jump"), [(0.0, 0.0), (1.5, 0.1)], ids=["clips", "another range"])
def test_fits_start_where_the_residual_tells_the_level(gain, jump):
    """Levels that are tried are 8 % apart."""
    level = 0.5 * np.abs(TORQUE).max()
    beyond = np.maximum(np.abs(TORQUE) - level, 0.0)
    error = np.sign(TORQUE) * ((gain - 1.0) * beyond + jump * (beyond > 0))
    own, _ = families(ranges_with(error))
    found = [p.start[0] for p in own.effect.parameters]
    assert found[0] == pytest.approx(level, rel=0.08)
    assert found[1:] == pytest.approx([gain, jump], abs=0.1)
