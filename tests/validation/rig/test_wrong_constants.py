"""Wrong constants: each follows its law, and looks exactly like what no log can tell it from."""

import math
from dataclasses import replace

import numpy as np
import pytest

from validation.logs.comparison import RigComparison
from validation.logs.equivalents import acceptable, as_effects
from validation.logs.sensors import BASE, TIP, TORQUE, LogSensors
from validation.rig.laws import LawParameters
from validation.rig.simulation import CellCounts, ideal_signals, presliding_shares

LIMIT = LawParameters(323.6, 0.018, 0.295).limit
FINEST_NOISE = LogSensors(noise={TIP: 1e-3, TORQUE: 1e-5, BASE: 1e-3}, claims={}, steps={})
COARSE = CellCounts(24, 20, 60)


@pytest.fixture
def differ(drive):
    """Rms difference of two rigs with nearly no noise, the other driven by the shown base angle."""
    comparison = RigComparison([drive(dt=0.01)], FINEST_NOISE, coarse=True)
    return lambda rig, other: comparison.signature(rig, other)


def scaled(**scales):
    return {name: {"scale": value} for name, value in scales.items()}


def test_a_torque_gain_is_stiffness_and_damping_off_alike(differ, make_rig):
    """Every torque of the linear needle is of stiffness or of damping."""
    rig = make_rig(**scaled(torque_scale=1.1))
    assert differ(rig, make_rig(**scaled(stiffness_error=1.1, damping_error=1.1))) < 1e-3
    assert differ(rig, make_rig(**scaled(stiffness_error=1.1))) > 1.0


@pytest.mark.parametrize("others", [("torque_scale",), ("stiffness_error", "damping_error")])
def test_an_encoder_gain_is_gains_of_tip_and_torque(differ, make_rig, others):
    """At a shown base s theta the true tip and torque are 1/s of the nominal ones."""
    s = 1.05
    rig = make_rig(**scaled(base_angle_scale=s))
    same = make_rig(**scaled(tip_angle_scale=1 / s, **dict.fromkeys(others, 1 / s)))
    assert differ(rig, same) < 1e-3
    assert differ(rig, make_rig(**scaled(tip_angle_scale=1 / s))) > 1.0


def test_a_known_torque_at_the_tip_gives_torques_a_scale(drive, make_rig):
    loaded = drive(dt=0.01, load=lambda time_s: np.sin(2 * time_s))
    comparison = RigComparison([loaded], FINEST_NOISE, coarse=True)
    rig = make_rig(**scaled(torque_scale=1.1))
    several = make_rig(**scaled(stiffness_error=1.1, damping_error=1.1))
    assert comparison.signature(rig, several) > 100.0
    assert acceptable(["torque_scale"], loaded=True) == []


def test_a_longer_free_shaft_is_a_spring_before_the_needle(differ, make_rig):
    rig = make_rig({"free_length_error": {"offset": 20.0}})
    spring = as_effects(rig)
    assert spring == {"base_compliance": {"stiffness": pytest.approx(rig.law().rigidity / 20.0)}}
    assert differ(rig, make_rig(**spring)) < 1e-3
    assert differ(rig, make_rig()) > 1.0
    assert as_effects(make_rig({"free_length_error": {"offset": -10.0}})) == {}


def test_a_thicker_needle_is_stiffer_by_the_fourth_power(differ, make_rig):
    rig = make_rig({"diameter_error": {"share": 0.05}})
    assert rig.law().radius == pytest.approx(1.05 * 0.295)
    assert as_effects(rig)["stiffness_error"]["scale"] == pytest.approx(1.05**4)
    assert differ(rig, make_rig(**as_effects(rig))) < 1e-3


def test_an_offset_of_the_inserted_length_is_that_length(drive, make_rig):
    """The log states 100 mm; the needle is 110 mm deep, its free length as logged."""
    wrong = ideal_signals(make_rig(inserted_offset={"offset": 10.0}), drive(), COARSE)
    true = ideal_signals(make_rig(), replace(drive(), inserted_mm=drive().inserted_mm + 10.0), COARSE)
    assert (wrong.torque_n_mm == true.torque_n_mm).all()
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


def test_what_no_log_can_tell_apart_keeps_the_other_effects_of_a_pair():
    found = acceptable(["torque_scale", "coulomb_friction"], loaded=False)
    assert found == [["coulomb_friction", "damping_error", "stiffness_error"]]
    assert acceptable(["base_angle_scale", "needle_curvature"], loaded=False) == []
    assert acceptable(["drive_friction"], loaded=False) == []
