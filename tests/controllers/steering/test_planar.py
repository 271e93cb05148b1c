"""The planar controller against the linear system that it is designed to be."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from controllers.steering.planar import PlanarController, PlanarState
from models.bevel import BevelTip
from models.errors import InvalidValue

RADIUS_MM = 61.0


def state_of(tip, roll):
    pull, onward = tip.pointing(roll)
    return PlanarState(tip.position_mm[2], tip.tangent[2], pull[2], onward[2])


def heights(controller, start_mm, *, step_mm=0.05, travel_mm=60.0):
    """Heights over the plane of a tip whose roll follows the controller at once, (N,)."""
    tip, roll, found = BevelTip(RADIUS_MM, (0, 0, start_mm)), 0.0, [start_mm]
    for _ in range(int(travel_mm / step_mm)):
        roll += step_mm * controller.roll_rate(state_of(tip, roll))
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
    assert abs(controller.roll_rate(PlanarState(50.0, 0.0, 0.0, 1.0))) == 0.5
    assert abs(heights(controller, 3.0, travel_mm=120.0)[-1]) < 0.05


def test_height_pitch_and_roll_of_the_tip_obey_the_three_equations_of_the_planar_system():
    """The path in 3-D against z' = sin b, b' = k sin g, g' = roll rate - k tan b cos g."""
    rate, travel, steps, k = 0.02, 40.0, 4000, 1 / RADIUS_MM
    tip = BevelTip(RADIUS_MM, (0, 0, 3.0))
    for i in range(steps):
        tip.advance(travel / steps, 0.3 + rate * travel * (i + 0.5) / steps)
    found = state_of(tip, 0.3 + rate * travel)

    def reduced(s, x):
        _, pitch, roll = x
        return [np.sin(pitch), k * np.sin(roll), rate - k * np.tan(pitch) * np.cos(roll)]

    z, pitch, roll = solve_ivp(reduced, (0, travel), [3.0, 0.0, 0.3], rtol=1e-10, atol=1e-12).y[:, -1]
    expected = [z, np.sin(pitch), np.cos(pitch) * np.sin(roll), np.cos(pitch) * np.cos(roll)]
    # Roll steps of 2e-4 rad at mid-step: (2e-4)^2 / 24 of the turn of the path.
    assert [found.height_mm, found.slope, found.pull, found.facing] == pytest.approx(expected, abs=1e-7)


@pytest.mark.parametrize("field", ["radius_mm", "settling_mm", "most_roll_rad_per_mm"])
@pytest.mark.parametrize("bad", [0.0, -1.0, math.inf])
def test_an_impossible_controller_is_refused_by_the_name_of_its_field(field, bad):
    with pytest.raises(InvalidValue, match=field):
        PlanarController(**({"radius_mm": RADIUS_MM} | {field: bad}))
