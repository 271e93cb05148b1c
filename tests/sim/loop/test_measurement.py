"""Readings: noise, bias, quantisation and delay, each by itself and in their order."""

import numpy as np
import pytest

from models.errors import InvalidValue
from sim.loop.hardware import Sensors
from sim.loop.measurement import CHANNELS, MeasurementNoise, SensorReadings, quantised

QUIET = MeasurementNoise()


def readings(sensors, noise=QUIET, samples=8):
    values = [(10.0 * i, 0.1 * i, -3.0 * i) for i in range(samples)]
    made = SensorReadings(sensors, noise, samples=samples, step_s=0.01)
    return dict(zip(CHANNELS, np.array([made.read(i, v) for i, v in enumerate(values)]).T, strict=True))


def test_ideal_sensors_show_what_is():
    shown = readings(Sensors())
    assert shown["base_deg"] == pytest.approx(10.0 * np.arange(8))
    assert shown["torque_n_mm"] == pytest.approx(0.1 * np.arange(8))
    assert shown["tip_deg"] == pytest.approx(-3.0 * np.arange(8))


def test_each_channel_has_its_own_delay():
    shown = readings(Sensors(base_delay_s=0.02, torque_delay_s=0.03))
    assert list(shown["base_deg"]) == [0, 0, 0, 10, 20, 30, 40, 50]
    assert shown["torque_n_mm"] == pytest.approx([0, 0, 0, 0, 0.1, 0.2, 0.3, 0.4])
    assert shown["tip_deg"] == pytest.approx(-3.0 * np.arange(8))


def test_the_bias_is_on_the_torque_alone():
    plain, biased = readings(Sensors()), readings(Sensors(torque_bias_n_mm=0.1))
    assert biased["torque_n_mm"] - plain["torque_n_mm"] == pytest.approx(0.1)
    assert np.array_equal(biased["base_deg"], plain["base_deg"])


@pytest.mark.parametrize(("value", "shown"), [(0.53, 0.36), (0.55, 0.72), (-0.55, -0.72), (0.0, 0.0)])
def test_an_encoder_shows_the_nearest_count(value, shown):
    assert quantised(value, 0.36) == pytest.approx(shown)
    assert quantised(value, 0.0) == value


def test_noise_is_quantised_with_the_signal():
    noise = MeasurementNoise(torque_n_mm=0.05, seed=2)
    counts = readings(Sensors(torque_step_n_mm=0.02), noise)["torque_n_mm"] / 0.02
    assert counts == pytest.approx(np.round(counts))
    assert not np.allclose(counts, 5 * np.arange(8))


def test_a_negative_spread_is_refused():
    with pytest.raises(InvalidValue, match="noise"):
        readings(Sensors(), MeasurementNoise(tip_deg=-1.0))
