"""Steady turning, with and without an effect."""

import math
from types import SimpleNamespace

import pytest

from validation.rig.simulation import ideal_signals

BETA, DEPTH, FREE, RATE = 0.018, 100.0, 80.0, math.radians(60)


@pytest.fixture
def steady():
    """Of steady turning: slip rate, rad/s, viscous torque, N mm, damping, inserted and free length."""
    return SimpleNamespace(rate=RATE, torque=BETA * RATE * DEPTH, beta=BETA, depth=DEPTH, free=FREE)


@pytest.fixture
def at_end(drive, make_rig, turn_steadily):
    """The last torque and tip angle after 12 s of steady turning, and the largest torque."""

    def run(*, speed=0.0, depth=DEPTH, end=12, **outside):
        motion = drive(turn_steadily, end=end, speed=speed, depth=depth)
        signals = ideal_signals(make_rig(outside), motion)
        return signals.torque_n_mm[-1], signals.tip_deg[-1], signals.torque_n_mm.max()

    return run
