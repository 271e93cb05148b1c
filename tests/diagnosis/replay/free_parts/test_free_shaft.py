"""Another shaft of the needle."""

import numpy as np
import pytest

from diagnosis.replay.free_parts.free_shaft import FreeShaft
from models.needle import NITINOL

SOFTER = FreeShaft(stiffness_along=(0.5, 0.5), stiffness_along_mm=100.0, tip_inertia_kg_m2=1e-9)


def test_as_it_stands_it_is_the_nominal_shaft():
    assert FreeShaft().of(NITINOL) == NITINOL


def test_the_needle_has_what_is_changed():
    needle = SOFTER.of(NITINOL)
    np.testing.assert_allclose(needle.stiffness_factors(np.array([0.0, 50.0, 100.0])), 0.5)
    assert needle.tip_inertia_kg_m2 == NITINOL.tip_inertia_kg_m2 + 1e-9


def test_half_of_a_change_multiplies_what_adds_and_takes_the_root_of_factors():
    half = SOFTER.times(0.5)
    assert half.stiffness_along == pytest.approx((np.sqrt(0.5),) * 2)
    assert half.tip_inertia_kg_m2 == pytest.approx(5e-10)
    assert FreeShaft(yield_torque_n_mm=1.0).times(0.5).yield_torque_n_mm == 2.0  # it yields later
    assert FreeShaft(yield_torque_n_mm=1.0).times(0.0).yield_torque_n_mm is None
