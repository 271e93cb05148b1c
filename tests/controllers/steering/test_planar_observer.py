"""The observer of the planar controller: its error dynamics, and a needle in three dimensions."""

import math

import numpy as np
import pytest
from scipy.linalg import expm

from controllers.steering.planar_observer import PlanarObserver
from models.bevel import BevelTip
from models.errors import InvalidValue

RADIUS_MM, SETTLING_MM, APART_MM, STEP_MM = 61.0, 8.0, 1.0, 0.1
K = 1 / RADIUS_MM


def truth(tip, roll):
    return np.array([tip.position_mm[2], tip.tangent[2], tip.pointing(roll)[0][2]])


def estimate(observer):
    state = observer.state
    return np.array([state.height_mm, state.slope, state.pull])


def errors(roll_of, *, late_steps=0, images=40, start=(0.0, 0.0, 0.0), pitch=0.0):
    """Errors of the estimate just before each exposure, (images, 3); no noise."""
    tip = BevelTip(RADIUS_MM, (0, 0, 3.0))
    tip.advance(pitch * RADIUS_MM, math.pi / 2)  # a needle that climbs
    observer = PlanarObserver(radius_mm=RADIUS_MM, settling_mm=SETTLING_MM)
    observer.expose()
    observer.see(tip.position_mm[2] - start[0])  # the first image sets the height
    found, travelled, steps = [], 0.0, round(APART_MM / STEP_MM)
    for _ in range(images):
        observer.expose()
        exposed = tip.position_mm[2]
        found.append(truth(tip, roll_of(travelled)) - estimate(observer))
        for step in range(steps):
            if step == late_steps:
                observer.see(exposed)
            rolled = roll_of(travelled + STEP_MM) - roll_of(travelled)
            tip.advance(STEP_MM, roll_of(travelled + STEP_MM / 2))
            observer.advance(STEP_MM, rolled)
            travelled += STEP_MM
    return np.array(found)


def test_the_transition_is_the_exponential_of_the_linear_system():
    a = np.array([[0, 1, 0], [0, 0, K], [0, -K, 0]])
    observer = PlanarObserver(radius_mm=RADIUS_MM)
    assert observer.transition(13.0) == pytest.approx(expm(13.0 * a), abs=1e-12)


@pytest.mark.parametrize("apart_mm", [1 / 3, 2 / 3, 4 / 3])
def test_the_error_from_image_to_image_has_its_three_poles_where_they_were_placed(apart_mm):
    observer = PlanarObserver(radius_mm=RADIUS_MM, settling_mm=SETTLING_MM)
    apart_mm = round(apart_mm, 3)
    step = observer.transition(apart_mm)
    closed = step @ (np.eye(3) - np.outer(observer.gain(apart_mm), [1, 0, 0]))
    pole = math.exp(-apart_mm / SETTLING_MM)
    # The polynomial and not the roots: a triple root magnifies rounding to its cube root.
    assert np.poly(closed) == pytest.approx(np.poly([pole] * 3), abs=1e-9)


@pytest.mark.parametrize("late_steps", [0, 7])
def test_without_roll_the_error_follows_the_linear_law_however_late_the_image(late_steps):
    found = errors(lambda s: 0.2, late_steps=late_steps, start=(0.4, 0, 0))
    observer = PlanarObserver(radius_mm=RADIUS_MM, settling_mm=SETTLING_MM)
    one = observer.transition(APART_MM) @ (np.eye(3) - np.outer(observer.gain(APART_MM), [1, 0, 0]))
    # The image of the very start has no travel before it, and corrects nothing.
    expected = np.array([np.linalg.matrix_power(one, j) @ found[1] for j in range(len(found) - 1)])
    assert abs(found[1]).max() > 0.1
    assert found[1:] == pytest.approx(expected, abs=1e-9)


def test_pitch_and_roll_are_found_from_the_height_of_a_needle_that_rolls():
    """It climbs by 3 deg and swings through +-0.5 rad; the observer starts level at roll 0."""
    swings = errors(lambda s: 0.5 * math.sin(s / 12), pitch=0.05, images=100, start=(0.5, 0, 0))
    assert abs(swings[0]).max() > 0.04
    # A step predicts with the roll at its start: half a step of 0.04 rad/mm, times its lag.
    assert abs(swings[-10:, 1:]).max() < 0.01


def test_an_image_without_a_position_changes_nothing():
    observer = PlanarObserver(radius_mm=RADIUS_MM)
    observer.expose()
    observer.see(2.0)
    observer.advance(1.0, 0.1)
    before = observer.state
    observer.expose()
    observer.see(math.nan)
    assert observer.state == before


def test_noise_cannot_make_the_direction_longer_than_a_unit_vector():
    observer = PlanarObserver(radius_mm=RADIUS_MM, settling_mm=1.0)
    observer.expose()
    observer.see(0.0)
    for _ in range(5):
        observer.advance(1.0, 0.0)
        observer.expose()
        observer.see(100.0)
    state = observer.state
    assert math.hypot(state.slope, state.pull) < 1.0
    assert state.facing > 0.0


@pytest.mark.parametrize("field", ["radius_mm", "settling_mm"])
@pytest.mark.parametrize("bad", [0.0, -1.0, math.nan])
def test_an_impossible_observer_is_refused_by_the_name_of_its_field(field, bad):
    with pytest.raises(InvalidValue, match=field):
        PlanarObserver(**({"radius_mm": RADIUS_MM} | {field: bad}))
