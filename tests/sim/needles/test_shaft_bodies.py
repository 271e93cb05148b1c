"""The bodies of the shaft together are the needle."""

import numpy as np
import pytest

from models.errors import InvalidValue
from models.needle import NITINOL
from sim.needles.shaft_bodies import shaft_bodies

NODES_MM = np.array([0.0, 10.0, 30.0, 60.0])
NEEDLE = NITINOL.but(tip_inertia_kg_m2=2e-12)
BODIES = shaft_bodies(NEEDLE, NODES_MM, rotor_inertia_kg_m2=3e-9)


def test_bodies_follow_one_another_without_a_gap():
    ends, starts = BODIES.node_m + BODIES.ahead_m, BODIES.node_m - BODIES.back_m
    np.testing.assert_allclose(ends[:-1], starts[1:])
    assert (starts[0], ends[-1]) == pytest.approx((0.0, 0.06))
    np.testing.assert_allclose(BODIES.node_m + BODIES.centre_m, 0.5 * (starts + ends))
    np.testing.assert_allclose(2 * BODIES.half_length_m, ends - starts)


def test_mass_and_inertia_are_those_of_the_needle_with_rotor_and_tip():
    assert BODIES.mass_kg.sum() == pytest.approx(NEEDLE.mass_kg_per_m * 0.06)
    own = NEEDLE.rotary_inertia_kg_m * np.array([5.0, 15.0, 25.0, 15.0]) * 1e-3
    np.testing.assert_allclose(BODIES.inertia_kg_m2[:, 0] - own, [3e-9, 0, 0, 2e-12], atol=1e-20)


def test_inertia_across_the_axis_is_that_of_a_solid_cylinder():
    mass, length, radius = BODIES.mass_kg[1], 15e-3, 0.5e-3 * NEEDLE.diameter_mm
    assert BODIES.inertia_kg_m2[1, 1] == pytest.approx(mass * (3 * radius**2 + length**2) / 12)
    assert np.all(BODIES.inertia_kg_m2[:, 1:] >= BODIES.inertia_kg_m2[:, :1])  # or MuJoCo refuses


def test_nodes_in_the_frame_of_their_parent():
    np.testing.assert_allclose(BODIES.from_parent_m(chain=True), [0, 0.01, 0.02, 0.03])
    np.testing.assert_allclose(BODIES.from_parent_m(chain=False), [0, 0.01, 0.03, 0.06])


def test_a_body_too_light_for_mujoco_is_refused_with_how_to_fix_it():
    with pytest.raises(InvalidValue, match="fewer elements"):
        shaft_bodies(NITINOL.but(diameter_mm=0.05), NODES_MM / 100, rotor_inertia_kg_m2=0.0)
