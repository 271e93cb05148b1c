"""Duty-cycled spinning: the roll over time, and the circle that the tip follows."""

import math

import numpy as np
import pytest

from controllers.steering.duty_cycle import DutyCycle, mean_pull
from models.bevel import path_mm
from models.errors import InvalidValue


def test_a_cycle_holds_and_then_turns_once_around():
    cycle = DutyCycle(duty=0.25, spin_deg_s=720, held_deg=30)
    assert cycle.period_s == 2.0
    times = [0.0, 1.0, 1.5, 1.75, 2.0, 3.0, 4.0]
    assert [cycle.roll_deg(t) for t in times] == pytest.approx([30, 30, 30, 210, 390, 390, 750])


def test_a_duty_of_zero_holds_and_of_one_spins_without_rest():
    assert DutyCycle(duty=0, held_deg=12).roll_deg(1e6) == 12
    always = DutyCycle(duty=1, spin_deg_s=90)
    assert [always.roll_deg(t) for t in (1, 5, 9)] == pytest.approx([90, 450, 810])


@pytest.mark.parametrize("duty", [0.0, 0.25, 0.5, 0.8])
def test_a_tip_that_follows_it_goes_round_a_circle_of_the_laws_curvature(duty):
    """Twenty quick cycles: the chord of the path is that of a circle of radius R / (1 - d)."""
    cycle = DutyCycle(duty=duty, spin_deg_s=3600 if duty else 360)
    travel = 20.0
    time = np.linspace(0, 20 * cycle.period_s if duty else 1.0, 8001)
    arc = travel * time / time[-1]
    roll = np.radians([cycle.roll_deg(t) for t in time])
    end = path_mm(arc, roll, radius_mm=61.0)[-1]
    bent = travel * cycle.curvature_share / 61.0
    expected = travel * np.array([np.sinc(bent / np.pi), math.sin(bent / 2) ** 2 / (bent / 2), 0])
    # Each cycle of 1 mm holds first: its mean direction is ahead of the circle's by d (1 - d) / 2R,
    # and the spin leaves the circle's plane by d / (2 pi R). Both go on over the travel.
    ahead = (0.5 * duty * (1 - duty) + duty / (2 * math.pi)) / 61.0
    assert end == pytest.approx(expected, abs=travel * ahead + 1e-6)
    assert mean_pull(roll, arc) == pytest.approx(cycle.curvature_share, abs=1e-3)


def test_the_mean_pull_has_the_direction_of_the_roll_in_its_argument():
    pull = mean_pull(np.full(5, 0.7), np.linspace(3, 9, 5))
    assert (abs(pull), math.atan2(pull.imag, pull.real)) == pytest.approx((1.0, 0.7))


@pytest.mark.parametrize("field", [{"duty": 1.2}, {"duty": -0.1}, {"duty": 0.5, "spin_deg_s": 0}])
def test_an_impossible_cycle_is_refused_by_name(field):
    with pytest.raises(InvalidValue, match=list(field)[-1]):
        DutyCycle(**field)
