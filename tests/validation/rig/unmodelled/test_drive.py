"""Effects of the drive follow their laws, and the encoder shows what the drive shaft does."""

from dataclasses import replace

import numpy as np
import pytest

from validation.rig.simulation import ideal_signals
from validation.rig.unmodelled.drive import eccentric_encoder, torque_ripple
from validation.rig.unmodelled.effect import IdealSignals

JUMP = {"angle": 20.0, "trial": 1.0, "share": 0.25}


def test_a_chuck_slips_at_its_torque(at_end):
    assert at_end(slipping_chuck={"torque": 1.0})[2] == pytest.approx(1.0)


def test_a_soft_insert_loses_its_angle_with_the_torque(at_end, steady):
    torque, tip, _ = at_end(soft_play={"angle": 30.0, "torque": 0.5})
    assert torque == pytest.approx(steady.torque, rel=1e-4)
    lost = 30.0 * steady.torque / (0.5 + steady.torque)
    assert at_end()[1] - tip == pytest.approx(lost, rel=1e-3)


def test_a_chuck_that_slips_once_lags_from_then_on_in_that_trial(drive, make_rig, turn_steadily):
    motion = replace(drive(turn_steadily, end=12), trial=1)
    slipped, nominal = (ideal_signals(make_rig(o), motion) for o in ({"chuck_jump": JUMP}, ()))
    lag = nominal.tip_deg - slipped.tip_deg
    before = motion.time_s < 3.0
    assert (lag[before] == 0).all()
    assert lag[-1] == pytest.approx(20.0, rel=1e-3)
    assert (slipped.base_deg == motion.base_deg).all()
    other = replace(motion, trial=0)
    assert (ideal_signals(make_rig({"chuck_jump": JUMP}), other).tip_deg == nominal.tip_deg).all()


def test_a_belt_that_creeps_turns_the_chuck_more_slowly(drive, make_rig, turn_steadily, at_end, steady):
    """Of 60 deg/s, 57 are left."""
    torque, tip, _ = at_end(drive_creep={"rate": 3.0})
    assert torque == pytest.approx(steady.torque * 57 / 60, rel=1e-3)
    assert tip == pytest.approx(at_end()[1] * 57 / 60, rel=1e-3)
    motion = drive(turn_steadily)
    shown = ideal_signals(make_rig({"drive_creep": {"rate": 3.0}}), motion)
    assert (shown.base_deg == motion.base_deg).all()


def test_an_eccentric_encoder_errs_once_per_turn_and_starts_at_zero(true_signals):
    shown = eccentric_encoder(true_signals, {"amplitude": 3.0, "phase": 40.0})
    base = true_signals.base_deg
    error = 3 * (np.sin(np.radians(base + 40)) - np.sin(np.radians(40)))
    assert shown.base_deg - base == pytest.approx(error)
    assert (shown.torque_n_mm == true_signals.torque_n_mm).all()


def test_cogging_adds_its_teeth_to_the_torque(true_signals):
    shown = torque_ripple(true_signals, {"amplitude": 0.1, "teeth": 4.0, "phase": 30.0})
    error = 0.1 * np.sin(np.radians(4 * true_signals.base_deg + 30))
    assert shown.torque_n_mm - true_signals.torque_n_mm == pytest.approx(error)
    assert (shown.base_deg == true_signals.base_deg).all()


@pytest.fixture
def true_signals():
    time_s = np.linspace(0, 5, 51)
    zero = 0 * time_s
    return IdealSignals(
        time_s=time_s, base_deg=70 * time_s, torque_n_mm=0.7 * time_s, tip_deg=zero, speed_mm_s=zero
    )
