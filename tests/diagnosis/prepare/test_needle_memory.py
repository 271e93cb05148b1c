"""Time constants of the nominal needle's modes."""

import numpy as np
import pytest
from diagnosis_fixtures import RIG

from diagnosis.prepare.needle_memory import time_constant_s


@pytest.mark.parametrize("mode", [1, 2, 3])
def test_a_needle_all_inserted_has_those_of_a_rod(mode):
    """damping L^2 / (rigidity k^2), k an odd multiple of pi / 2: one end held, the other free."""
    length_mm, damping = 90.0, RIG.tissue.damping_n_mm_s_per_mm
    k = (2 * mode - 1) * np.pi / 2
    expected = damping * length_mm**2 / (RIG.rigidity_n_mm2 * k**2)
    assert time_constant_s(RIG, length_mm, 0.0, mode=mode) == pytest.approx(expected, rel=1e-6)


def test_a_free_length_makes_it_slower():
    assert time_constant_s(RIG, 90.0, 60.0, mode=1) > 1.5 * time_constant_s(RIG, 90.0, 0.0, mode=1)


def test_a_tip_outside_of_the_tissue_forgets_at_once():
    assert 0 < time_constant_s(RIG, 0.0, 100.0, mode=1) < 0.02
