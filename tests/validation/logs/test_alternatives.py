"""Alternative explanations: what a wrong effect can explain, and what it cannot."""

import pytest

from validation.logs.alternatives import find_alternatives
from validation.logs.comparison import RigComparison


@pytest.fixture
def comparison(drive, sensors):
    """Of one trial at constant depth."""
    return RigComparison([drive(dt=0.01, end=6.0)], sensors, coarse=True)


def test_the_same_law_by_another_name_explains_all(comparison, make_rig):
    """Where the needle does not slide, shared dry friction is Coulomb friction."""
    rig = make_rig(coulomb_friction={"level": 0.003})
    found = find_alternatives(
        comparison, rig, ("coulomb_friction",), ("speed_dependent_friction", "tip_angle_bias")
    )
    assert next(iter(found.alone)) == "speed_dependent_friction"
    assert found.alone["speed_dependent_friction"] < 0.3
    assert found.alone["tip_angle_bias"] > 1.0


def test_a_pair_explains_at_least_as_much_as_the_better_of_the_two(comparison, make_rig):
    """Up to the ridge of 1e-9 in its normal equations."""
    rig = make_rig(tip_drag={"damping": 0.5})
    found = find_alternatives(comparison, rig, ("tip_drag",), ("damping_error", "base_compliance"))
    assert set(found.pair) == {"damping_error", "base_compliance"}
    assert found.pair_residual <= min(found.alone.values()) * (1 + 1e-6)


def test_a_single_true_effect_is_not_its_own_alternative(comparison, make_rig):
    rig = make_rig(tip_angle_bias={"bias": 2.0}, torque_bias={"bias": 0.1})
    alone = find_alternatives(comparison, rig, ("tip_angle_bias",), ("tip_angle_bias", "torque_bias"))
    assert set(alone.alone) == {"torque_bias"}
    pair = ("tip_angle_bias", "torque_bias")
    both = find_alternatives(comparison, rig, pair, pair)
    assert set(both.alone) == set(pair)
    assert both.pair_residual < 0.05  # biases add up: the pair is the truth
