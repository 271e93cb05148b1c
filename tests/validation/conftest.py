"""Trials and rigs that several tests of the validation share."""

import numpy as np
import pytest

from validation.rig.motion import TrialMotion
from validation.rig.rig import IndependentRig

BETA, DEPTH, FREE = 0.018, 100.0, 80.0


def swing(time_s):
    """To 120 deg and back, to -120 deg and back, with rests."""
    return 120 * np.sin(2.5 * time_s) ** 2 * np.sign(np.sin(2.5 * time_s))


def turn_steadily(time_s):
    """60 deg/s."""
    return 60 * time_s


def drive(
    base=swing, *, dt=0.0025, end=3.0, speed=0.0, growing=False, load=None, depth=DEPTH, free=FREE
):
    """A trial: `base` and `load` are functions of time; the needle slides with `speed`."""
    time_s = np.arange(round(end / dt) + 1) * dt
    return TrialMotion(
        dt_s=dt,
        per_sample=1,
        base_deg=base(time_s),
        inserted_mm=depth + speed * time_s * growing,
        free_mm=free - speed * time_s,
        speed_mm_s=np.full_like(time_s, speed),
        tip_torque_n_mm=None if load is None else load(time_s),
    )


def make_rig(outside=(), **effects):
    """A rig of the nominal needle with these effects."""
    return IndependentRig(damping_n_mm_s_per_mm=BETA, effects=effects, outside=dict(outside))


@pytest.fixture(name="drive")
def _drive():
    return drive


@pytest.fixture(name="make_rig")
def _make_rig():
    return make_rig


@pytest.fixture(name="swing")
def _swing():
    return swing


@pytest.fixture(name="turn_steadily")
def _turn_steadily():
    return turn_steadily
