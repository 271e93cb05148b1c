"""Sets of effects that no log can tell apart: on the rig itself, with nearly no noise."""

import numpy as np
import pytest

from validation.logs.comparison import RigComparison
from validation.logs.equivalents import acceptable, as_effects
from validation.logs.sensors import BASE, TIP, TORQUE, LogSensors

FINEST_NOISE = LogSensors(noise={TIP: 1e-3, TORQUE: 1e-5, BASE: 1e-3}, claims={}, steps={})


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


def test_any_two_scales_of_torques_stand_for_any_other_two(differ, make_rig):
    rig = make_rig(**scaled(stiffness_error=1.2, damping_error=0.9))
    assert differ(rig, make_rig(**scaled(torque_scale=1.2, damping_error=0.75))) < 1e-3
    assert differ(rig, make_rig(**scaled(torque_scale=0.9, stiffness_error=4 / 3))) < 1e-3
    assert differ(rig, make_rig()) > 1.0
    two = [["damping_error", "torque_scale"], ["stiffness_error", "torque_scale"]]
    assert acceptable(["stiffness_error", "damping_error"], loaded=False) == two[::-1]
    assert acceptable(["stiffness_error", "damping_error"], loaded=True) == []
    with_drag = acceptable(["torque_scale", "damping_error", "tip_drag"], loaded=False)
    assert ["damping_error", "stiffness_error", "tip_drag"] in with_drag
    assert ["stiffness_error", "tip_drag", "torque_scale"] in with_drag


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


def test_what_no_log_can_tell_apart_keeps_the_other_effects_of_a_pair():
    found = acceptable(["torque_scale", "coulomb_friction"], loaded=False)
    assert found == [["coulomb_friction", "damping_error", "stiffness_error"]]
    assert acceptable(["base_angle_scale", "needle_curvature"], loaded=False) == []
    assert acceptable(["drive_friction"], loaded=False) == []
