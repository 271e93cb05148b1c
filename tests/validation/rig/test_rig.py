"""The rig: parameters of effects in the units of its laws, and names that it refuses."""

import math

import pytest

from models.needle import NITINOL
from validation.rig.rig import IndependentRig


def test_a_rig_without_effects_is_the_nominal_needle(make_rig):
    law = make_rig().law()
    assert law.rigidity == pytest.approx(NITINOL.rigidity_n_mm2, rel=1e-12)
    assert (law.damping, law.radius) == (0.018, 0.295)
    assert (law.coulomb, law.compliance, law.half_gap, law.grip) == (0.0, 0.0, 0.0, math.inf)


@pytest.mark.parametrize(
    ("effects", "field", "value"),
    [
        ({"stiffness_error": {"scale": 1.1}}, "rigidity", 1.1 * NITINOL.rigidity_n_mm2),
        ({"damping_error": {"scale": 0.9}}, "damping", 0.9 * 0.018),
        ({"tissue_viscoelasticity": {"stiffness": 0.05, "time_constant": 0.3}}, "compliance", 20.0),
        ({"base_compliance": {"stiffness": 8.0}}, "base_compliance", 0.125),
        ({"chuck_backlash": {"gap": 6.0}}, "half_gap", math.radians(3)),
        ({"needle_curvature": {"torque": 0.001, "phase": 90.0}}, "phase", math.pi / 2),
        ({"coulomb_friction": {"level": 0.004}}, "coulomb", 0.004),
    ],
)
def test_parameters_arrive_in_the_units_of_the_laws(make_rig, effects, field, value):
    assert getattr(make_rig(**effects).law(), field) == pytest.approx(value, rel=1e-9)


def test_a_sensor_without_an_effect_is_neutral(make_rig):
    assert make_rig().sensor("tip_angle_scale", "scale") == 1.0
    assert make_rig(tip_angle_scale={"scale": 0.9}).sensor("tip_angle_scale", "scale") == 0.9


@pytest.mark.parametrize(
    ("how", "message"),
    [
        (
            {"effects": {"magnetism": {}}},
            "effects: expected some of coulomb_friction.*found 'magnetism'",
        ),
        ({"effects": {"coulomb_friction": {"slope": 1.0}}}, "coulomb_friction with .'level'.*slope"),
        ({"outside": {"magnetism": {}}}, "outside: expected some of lubrication.*found 'magnetism'"),
    ],
)
def test_unknown_effects_and_parameters_are_named(how, message):
    with pytest.raises(ValueError, match=message):
        IndependentRig(damping_n_mm_s_per_mm=0.018, **how)
