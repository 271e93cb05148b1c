"""Plans of least time: within their limits, and true to the closed form of the needle."""

import numpy as np
import pytest

from controllers.least_time import LeastTime, plan
from controllers.limits import MotorLimits
from controllers.modal_lag import BaseModes
from controllers.signals import Estimate, Sample
from models.errors import InvalidValue
from models.modes import InsertedNeedle
from models.needle import NITINOL

BETA, BAND_DEG = 0.01725, 2.0
HELD = InsertedNeedle(needle=NITINOL, damping_n_mm_s_per_mm=BETA, inserted_mm=100.0, free_mm=50.0)


def planned(limits=MotorLimits(), reference_deg=90.0, steps=120):  # noqa: B008 - frozen
    return plan(
        BaseModes(HELD, 10, 3),
        start_s=0.0,
        base_deg=0.0,
        lag_deg=np.zeros(10),
        reference_deg=reference_deg,
        limits=limits,
        band_deg=BAND_DEG,
        steps=steps,
    )


@pytest.mark.parametrize("reference_deg", [90.0, -40.0])
def test_the_planned_tip_settles_when_the_plan_says_and_overshoots_by_the_band_at_most(reference_deg):
    made = planned(reference_deg=reference_deg)
    error = (reference_deg - made.tip_deg) * np.sign(reference_deg)
    rounding = 1e-6  # of the linear program, deg
    assert np.abs(error[made.times_s >= made.settling_s - 1e-9]).max() <= BAND_DEG + rounding
    assert error.min() >= -BAND_DEG - rounding
    assert abs(error[made.times_s < made.settling_s - 1e-9][-1]) > BAND_DEG - rounding


def test_the_planned_tip_is_that_of_the_closed_form():
    made = planned()
    exact = HELD.respond(made.times_s, np.radians(made.base_deg), count=10)
    assert made.tip_deg == pytest.approx(np.degrees(exact.tip_rad), abs=1e-6)


@pytest.mark.parametrize("rate", [300.0, 1500.0])
@pytest.mark.parametrize("torque", [2.0, 20.0])
def test_a_plan_keeps_to_the_rate_and_the_torque_of_the_motor(rate, torque):
    made = planned(MotorLimits(rate_deg_s=rate, torque_n_mm=torque))
    assert np.abs(np.diff(made.base_deg) / np.diff(made.times_s)).max() <= rate * (1 + 1e-9)
    exact = HELD.respond(made.times_s, np.radians(made.base_deg), count=10)
    assert np.abs(exact.base_torque_n_mm).max() <= torque * (1 + 1e-6)


def test_a_stronger_motor_settles_sooner():
    weak, strong = (planned(MotorLimits(rate_deg_s=r)).settling_s for r in (400.0, 1500.0))
    assert strong < weak


def test_a_motor_that_cannot_hold_the_needle_gets_no_plan():
    assert planned(MotorLimits(torque_n_mm=0.01)) is None


def test_a_plan_that_the_tip_does_not_follow_is_dropped_for_the_compensator():
    controller = LeastTime(NITINOL, MotorLimits(), damping_n_mm_s_per_mm=BETA)
    stuck = Estimate(0.0, np.zeros(3), BETA)
    for i in range(400):  # the tip stays at 0 while the plan turns it
        command = controller.command(90.0, Sample(0.001 * i, 0.0, 0.0, 100.0, 50.0), stuck)
    assert command.base_deg == pytest.approx(90 + 1.5 * 90)


@pytest.mark.parametrize(("field", "bad"), [("band_deg", 0), ("steps", 9)])
def test_an_impossible_planner_is_refused_by_the_name_of_its_field(field, bad):
    with pytest.raises(InvalidValue, match=field):
        LeastTime(NITINOL, MotorLimits(), damping_n_mm_s_per_mm=BETA, **{field: bad})
