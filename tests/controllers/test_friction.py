"""The controller for dry friction: winding, rest, unwinding, and retraction."""

import math

import numpy as np
import pytest

from controllers.friction import FrictionAware, Phase
from controllers.limits import MotorLimits
from controllers.signals import Estimate, Sample
from models.errors import InvalidValue

BETA = 0.01725


def sample(time=0.0, base=0.0, torque=0.0, depth=100.0):
    return Sample(time, base, torque, depth, 50.0)


def test_the_friction_aware_controller_asks_for_retraction_when_it_can_wind_no_further():
    controller = FrictionAware(MotorLimits(torque_n_mm=0.5))
    stuck = Estimate(80.0, np.zeros(3), BETA)
    phases, advances = set(), []
    for i in range(4000):
        command = controller.command(90.0, sample(0.001 * i, base=95.0, torque=0.6), stuck)
        phases.add(controller.phase)
        advances.append(command.advance_mm)
    assert Phase.RETRACTING in phases
    assert min(advances) == pytest.approx(-5.0, abs=0.05)


def driven(controller, tip_deg, seconds, *, start_s=0.0):
    """The phases that a controller passes through, and its last command, with a tip that stays."""
    phases = []
    for i in range(int(100 * seconds)):
        command = controller.command(90.0, sample(start_s + 0.01 * i), Estimate(tip_deg, np.zeros(3)))
        if not phases or phases[-1] is not controller.phase:
            phases.append(controller.phase)
    return phases, command


def wound_up():
    """A controller that has wound on for 2 s with the tip 3 deg short, by 4 / s of that."""
    controller = FrictionAware(MotorLimits(), rest_s=0.5)
    driven(controller, 87.0, 2.0)
    return controller


def test_once_the_tip_has_come_the_base_rests_and_then_unwinds_half_of_the_lag():
    controller = wound_up()
    _, resting = driven(controller, 89.8, 0.3, start_s=2.0)
    assert controller.phase is Phase.RESTING
    phases, last = driven(controller, 89.8, 1.0, start_s=2.3)
    assert phases == [Phase.RESTING, Phase.UNWINDING]
    assert resting.base_deg > 110
    # The mean error follows within 50 ms: after 0.5 s to e^-10 of 2.8 deg.
    assert last.base_deg - 89.8 == pytest.approx(0.5 * (resting.base_deg - 89.8), abs=1e-3)


def test_noise_in_the_estimate_ends_no_phase():
    """With 4 deg of it, every tenth sample is within the dead band while the tip is 5 deg short."""
    controller, rng = FrictionAware(MotorLimits()), np.random.default_rng(0)
    for i in range(1000):
        noisy = Estimate(85.0 + rng.normal(0, 4.0), np.zeros(3))
        controller.command(90.0, sample(0.002 * i), noisy)
        assert controller.phase is Phase.WINDING


def test_a_lag_that_falls_while_the_base_rests_is_not_unwound():
    """In viscous tissue the lag decays; what is unwound of it would be missing at the end."""
    controller = wound_up()
    _, rested = driven(controller, 89.8, 0.3, start_s=2.0)
    controller._held_deg = 2 * (rested.base_deg - 89.8)  # as much again has been lost meanwhile
    _, last = driven(controller, 89.8, 0.5, start_s=2.3)
    assert controller.phase is Phase.RESTING
    assert last.base_deg == rested.base_deg


def test_a_torque_that_only_passes_its_limit_asks_for_no_retraction():
    controller = FrictionAware(MotorLimits(torque_n_mm=0.5), rest_s=0.5)
    for i in range(600):
        torque = 0.6 if i % 40 < 20 else 0.4
        controller.command(90.0, sample(0.01 * i, torque=torque), Estimate(70.0, np.zeros(3)))
        assert controller.phase is Phase.WINDING


def test_a_tip_that_slips_away_while_the_base_rests_is_wound_again():
    controller = FrictionAware(MotorLimits(), rest_s=5.0)
    driven(controller, 90.0, 0.2)
    assert controller.phase is Phase.RESTING
    driven(controller, 85.0, 0.2, start_s=0.2)
    assert controller.phase is Phase.WINDING


def test_the_base_winds_on_as_long_as_the_tip_is_short():
    controller = FrictionAware(MotorLimits(), winding_per_s=4.0, gain=1.5)
    _, early = driven(controller, 87.0, 0.5)
    _, late = driven(controller, 87.0, 1.0, start_s=0.5)
    # 4 / s times 3 deg: 12 deg a second
    assert late.base_deg - early.base_deg == pytest.approx(12.0, rel=0.01)


@pytest.mark.parametrize(
    ("field", "bad"),
    [("dead_band_deg", math.nan), ("gain", -1), ("winding_per_s", 0), ("rest_s", 0), ("retract_mm", -1)],
)
def test_an_impossible_controller_is_refused_by_the_name_of_its_field(field, bad):
    with pytest.raises(InvalidValue, match=field):
        FrictionAware(MotorLimits(), **{field: bad})
