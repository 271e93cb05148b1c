"""Hardware of a loop, and what is refused."""

import math

import pytest

from models.errors import InvalidValue
from sim.loop.hardware import LoopHardware, Sensors


@pytest.mark.parametrize("field", [name for name in Sensors.model_fields if "bias" not in name])
@pytest.mark.parametrize("bad", [-1.0, math.nan])
def test_an_impossible_sensor_is_refused_by_the_name_of_its_field(field, bad):
    with pytest.raises(InvalidValue, match=field):
        Sensors(**{field: bad})


def test_an_impossible_drive_is_refused_by_the_name_of_its_field():
    with pytest.raises(InvalidValue, match="command_latency_s"):
        LoopHardware(command_latency_s=-0.01)
    with pytest.raises(InvalidValue, match="damping_ratio"):
        LoopHardware(servo={"natural_frequency_hz": 10, "damping_ratio": 0})


def test_hardware_is_ideal_unless_it_says_otherwise():
    assert set(Sensors().model_dump().values()) == {0.0}
    assert (LoopHardware().command_latency_s, LoopHardware().servo) == (0.0, None)
