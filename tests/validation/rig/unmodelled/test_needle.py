"""Effects of shaft and tip against the statics of the shaft."""

import math

import numpy as np
import pytest

from models.needle import NITINOL
from validation.rig.simulation import ideal_signals
from validation.rig.unmodelled.needle import EFFECTS

KAPPA = NITINOL.rigidity_n_mm2


def test_a_hardening_shaft_twists_less(at_end):
    assert at_end(hardening_shaft={"coefficient": 1e4})[1] > at_end()[1] + 1


def set_by_hand(steady, torque, slope):
    """The strain set is (torque there - yield torque) / (slope kappa), where the torque is above it."""
    excess = steady.torque - torque
    beyond = excess**2 / (2 * steady.torque) * steady.depth  # torque falls evenly to 0 at the tip
    return math.degrees((excess * steady.free + beyond) / (slope * KAPPA))


def test_a_shaft_twists_plastically_beyond_its_yield_torque(at_end, steady):
    """Where it yields, a shaft of a third of the stiffness settles three times as slowly: 24 s."""
    torque, tip, _ = at_end(end=24, permanent_set={"torque": 1.0, "slope": 0.5})
    assert torque == pytest.approx(steady.torque, rel=1e-3)
    assert at_end(end=24)[1] - tip == pytest.approx(set_by_hand(steady, 1.0, 0.5), rel=2e-3)


def test_a_set_remains_when_the_torque_is_gone(drive, make_rig, steady):
    """The back torque left, 0.885 N mm, is below the yield torque: nothing turns back."""

    def turn_and_rest(time_s):
        return 60 * np.minimum(time_s, 24.0)

    rig = make_rig({"permanent_set": {"torque": 1.0, "slope": 0.5}})
    signals = ideal_signals(rig, drive(turn_and_rest, dt=0.01, end=40))
    assert signals.torque_n_mm[-1] == pytest.approx(0.0, abs=1e-3)
    left = signals.base_deg[-1] - signals.tip_deg[-1]
    assert left == pytest.approx(set_by_hand(steady, 1.0, 0.5), rel=2e-3)


def test_dry_friction_at_the_tip_twists_the_whole_shaft(at_end, steady):
    torque, tip, _ = at_end(tip_friction={"level": 0.3})
    assert torque - steady.torque == pytest.approx(0.3, rel=1e-3)
    more = math.degrees(0.3 * (steady.depth + steady.free) / KAPPA)
    assert at_end()[1] - tip == pytest.approx(more, rel=1e-3)


@pytest.mark.parametrize("base", [20.0, 110.0])
def test_a_tip_in_fibres_rests_where_the_shaft_balances_it(drive, make_rig, steady, base):
    def held(time_s):
        return base * np.clip(time_s, 0, 1)

    rig = make_rig({"tip_in_fibres": {"torque": 0.4, "phase": 30.0}})
    signals = ideal_signals(rig, drive(held, dt=0.01, end=20))
    torque, tip = signals.torque_n_mm[-1], signals.tip_deg[-1]
    assert torque == pytest.approx(0.4 * math.sin(2 * math.radians(tip - 30)), abs=1e-4)
    twist = math.degrees(torque * (steady.depth + steady.free) / KAPPA)
    assert base - tip == pytest.approx(twist, abs=1e-2)
    assert abs(torque) > 0.01


def test_all_change_the_law():
    assert all(effect.law for effect in EFFECTS.values())
