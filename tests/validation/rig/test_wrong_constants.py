"""Wrong constants of the rig: each follows its law and changes nothing else."""

import math
from dataclasses import replace

import numpy as np
import pytest

from validation.rig.laws.parameters import LawParameters
from validation.rig.simulation import CellCounts, ideal_signals, presliding_shares

LIMIT = LawParameters(323.6, 0.018, 0.295).limit
COARSE = CellCounts(24, 20, 60)


def test_an_offset_of_the_inserted_length_is_that_length(drive, make_rig):
    """The log states 100 mm; the needle is 110 mm deep, its free length as logged."""
    wrong = ideal_signals(make_rig(inserted_offset={"offset": 10.0}), drive(), COARSE)
    true = ideal_signals(make_rig(), replace(drive(), inserted_mm=drive().inserted_mm + 10.0), COARSE)
    assert (wrong.torque_n_mm == true.torque_n_mm).all()
    assert (wrong.tip_deg == true.tip_deg).all()


def test_gains_are_of_one_sensor_each(drive, make_rig):
    plain = ideal_signals(make_rig(), drive(), COARSE)
    torque = ideal_signals(make_rig(torque_scale={"scale": 1.1}), drive(), COARSE)
    base = ideal_signals(make_rig(base_angle_scale={"scale": 0.9}), drive(), COARSE)
    assert torque.torque_n_mm == pytest.approx(1.1 * plain.torque_n_mm, rel=1e-12)
    assert base.base_deg == pytest.approx(0.9 * plain.base_deg, rel=1e-12)
    assert (torque.tip_deg == plain.tip_deg).all()
    assert (torque.base_deg == plain.base_deg).all()
    assert (base.tip_deg == plain.tip_deg).all()
    assert (base.torque_n_mm == plain.torque_n_mm).all()


def test_a_free_length_error_is_added_to_the_logged_length(drive, make_rig):
    wrong = ideal_signals(make_rig({"free_length_error": {"offset": -15.0}}), drive(), COARSE)
    true = ideal_signals(make_rig(), replace(drive(), free_mm=drive().free_mm - 15.0), COARSE)
    assert (wrong.tip_deg == true.tip_deg).all()


def test_a_late_torque_is_the_torque_of_before(drive, make_rig, turn_steadily):
    on_time = ideal_signals(make_rig(), drive(turn_steadily), COARSE)
    late = ideal_signals(make_rig(torque_sensor_delay={"delay": 0.1}), drive(turn_steadily), COARSE)
    assert late.torque_n_mm[40:] == pytest.approx(on_time.torque_n_mm[:-40], abs=1e-12)
    assert (late.tip_deg == on_time.tip_deg).all()


def test_the_torque_sensor_alone_feels_a_dry_bearing(drive, make_rig):
    free = ideal_signals(make_rig(), drive(), COARSE)
    dry = ideal_signals(make_rig(drive_friction={"level": 0.2}), drive(), COARSE)
    assert (dry.tip_deg == free.tip_deg).all()
    more = dry.torque_n_mm - free.torque_n_mm
    assert np.abs(more).max() == pytest.approx(0.2)
    rate = np.gradient(drive().base_deg, drive().dt_s)
    turning = np.abs(rate) > 60
    assert more[turning] == pytest.approx(0.2 * np.sign(rate[turning]), abs=1e-9)


def test_a_bearing_springs_back_within_its_presliding_angle():
    """Turned by 1 deg and back by 0.05: half of 0.1 deg is taken from a full presliding."""
    turned = np.radians([0.0, 0.05, 1.0, 0.95, 0.0])
    assert presliding_shares(turned, LIMIT) == pytest.approx([0.0, 0.5, 1.0, 0.5, -1.0])
    assert pytest.approx(0.1) == math.degrees(LIMIT)
