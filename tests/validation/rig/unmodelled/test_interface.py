"""Effects at the interface follow their laws: torques of steady turning, computed by hand."""

import math

import numpy as np
import pytest

from models.needle import NITINOL
from validation.rig.simulation import ideal_signals
from validation.rig.unmodelled.interface import EFFECTS

KAPPA = NITINOL.rigidity_n_mm2


def test_lubrication_takes_away_its_share_of_the_damping(at_end, steady):
    torque = at_end(lubrication={"share": 0.5, "angle": 60.0})[0]
    assert torque == pytest.approx(0.5 * steady.torque, rel=1e-3)


@pytest.mark.parametrize(("share", "time"), [(0.5, 2.0), (0.9, 1000.0)])
def test_damping_that_decays_has_its_share_left_at_a_time(at_end, steady, share, time):
    """The shaft unwinds meanwhile, with a time constant below 1 s: 1e-3 of the torque or less."""
    torque = at_end(damping_decay={"share": share, "time": time})[0]
    left = 1 - share * (1 - math.exp(-12 / time))
    assert torque == pytest.approx(left * steady.torque, rel=2e-3)
    assert left < 0.99


def test_damping_that_saturates_is_divided_by_one_plus_the_rate(at_end, steady):
    torque = at_end(saturating_damping={"rate": 0.5})[0]
    assert torque == pytest.approx(steady.torque / (1 + steady.rate / 0.5), rel=1e-3)


def test_one_way_friction_depends_on_the_side(at_end, steady):
    torque = at_end(one_way_friction={"level": 0.004, "asymmetry": 0.5})[0]
    assert torque - steady.torque == pytest.approx(0.006 * steady.depth, rel=1e-3)


@pytest.mark.parametrize("speed", [0.0, 2.0, -2.0])
def test_friction_is_relieved_by_axial_speed_of_either_sign(at_end, steady, speed):
    """A free shaft that shortens at speed v unwinds: the needle turns faster by torque v / kappa."""
    torque = at_end(speed=speed, axially_relieved_friction={"level": 0.004, "speed": 1.0})[0]
    dry = 0.004 * steady.depth * math.exp(-abs(speed))
    faster = 1 - steady.beta * steady.depth * speed / KAPPA
    assert torque == pytest.approx((steady.torque + dry) / faster, rel=1e-3)


@pytest.mark.parametrize("depth", [100.0, 50.0])
def test_friction_of_depth_has_the_moments_of_its_power(at_end, steady, depth):
    """Integrals of (x / 100)^2 and of x (x / 100)^2 over the inserted length."""
    more, tip, _ = at_end(depth=depth, friction_of_depth={"level": 0.004, "exponent": 2.0})
    torque, nominal, _ = at_end(depth=depth)
    dry = 0.004 * depth**3 / 3e4
    assert more - torque == pytest.approx(dry, rel=2e-3)
    lever = 3 / 4 * depth + steady.free
    assert nominal - tip == pytest.approx(math.degrees(dry * lever / KAPPA), rel=2e-3)


def test_contacts_that_rested_hold_more(drive, make_rig):
    def rest_then_turn(time_s):
        return 90 * np.clip(time_s - 8, 0, 1)

    outside = {"friction_ageing": {"level": 0.002, "growth": 0.002, "time": 0.5, "angle": 1.0}}
    rested = ideal_signals(make_rig(outside), drive(rest_then_turn, end=10))
    fresh = ideal_signals(make_rig(outside), drive(lambda time_s: rest_then_turn(time_s + 8), end=2))
    assert rested.torque_n_mm.max() > fresh.torque_n_mm.max() + 0.02


def test_all_change_the_law():
    assert all(effect.law for effect in EFFECTS.values())
