"""Axial travel."""

import pytest

from diagnosis.log.checks.travel import travelled_mm
from diagnosis.log.rig_log import read_rig_log


def test_travel_is_the_integral_of_the_speed(log):
    slides = read_rig_log(log).trials[1]
    # Constant speed: the trapezoidal rule is exact, the times are rounded to 1e-4 s.
    assert travelled_mm(slides) == pytest.approx(-2.5 * slides["time_s"], abs=1e-3)
