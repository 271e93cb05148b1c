"""The planar controller against the linear system that it is designed to be."""

import math

import numpy as np
import pytest

from controllers.planar import PlanarController
from models.bevel import BevelTip
from models.errors import InvalidValue

RADIUS_MM = 61.0


def heights(controller, start_mm, *, step_mm=0.05, travel_mm=60.0):
    """Heights over the plane of a tip whose roll follows the controller at once, (N,)."""
    tip, roll, found = BevelTip(RADIUS_MM, (0, 0, start_mm)), 0.0, [start_mm]
    for _ in range(int(travel_mm / step_mm)):
        pull, onward = tip.pointing(roll)
        roll += step_mm * controller.roll_rate(tip.position_mm[2], tip.tangent, pull, onward)
        tip.advance(step_mm, roll)
        found.append(tip.position_mm[2])
    return np.array(found)


def test_small_heights_decay_as_three_equal_poles_say():
    """From rest z = z0 (1 + x + x^2 / 2) exp(-x), x in settling lengths."""
    start, step = 0.05, 0.05
    found = heights(PlanarController(radius_mm=RADIUS_MM, settling_mm=10.0), start, step_mm=step)
    x = step * np.arange(found.size) / 10.0
    expected = start * (1 + x + x**2 / 2) * np.exp(-x)
    # Steps of 0.05 mm delay the roll by half a step: 0.25 % of a settling length, three poles.
    assert np.abs(found - expected).max() < 0.01 * start


def test_from_far_away_the_roll_is_limited_and_the_tip_still_comes_into_the_plane():
    controller = PlanarController(radius_mm=RADIUS_MM)
    far = np.array([1.0, 0, 0])
    rate = controller.roll_rate(50.0, far, np.array([0, 1.0, 0]), np.array([0, 0, 1.0]))
    assert abs(rate) == 0.5
    assert abs(heights(controller, 3.0, travel_mm=120.0)[-1]) < 0.05


@pytest.mark.parametrize("field", ["radius_mm", "settling_mm", "most_roll_rad_per_mm"])
@pytest.mark.parametrize("bad", [0.0, -1.0, math.inf])
def test_an_impossible_controller_is_refused_by_the_name_of_its_field(field, bad):
    with pytest.raises(InvalidValue, match=field):
        PlanarController(**({"radius_mm": RADIUS_MM} | {field: bad}))
