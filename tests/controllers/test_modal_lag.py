"""The lag of the shaft in the modes of the base-driven needle."""

import numpy as np
import pytest

from controllers.modal_lag import BaseModes
from controllers.signals import Estimate
from models.modes import InsertedNeedle
from models.needle import NITINOL

BETA = 0.01725


def held(free=50.0):
    return InsertedNeedle(needle=NITINOL, damping_n_mm_s_per_mm=BETA, inserted_mm=100.0, free_mm=free)


def test_a_uniform_lag_has_the_modes_that_the_closed_form_gives_it():
    modes = BaseModes(held(), 3, 3)
    found = modes.lag_modes_rad(Estimate(80.0, np.zeros(3)), base_deg=90.0)
    # Least squares on 201 points against integrals: modes of a needle with a free length are
    # orthogonal, sums over points differ from integrals by 1 / 201 of the ends.
    assert found == pytest.approx(np.radians(-10) * held().participation(3), rel=0.03)


def test_modes_of_the_estimate_are_projected_on_modes_that_sum_up_to_the_tip():
    modes = BaseModes(held(), 12, 3)
    found = modes.lag_modes_rad(Estimate(80.0, np.array([-8.0, 1.0, -0.5])), base_deg=90.0)
    assert np.degrees(found.sum()) == pytest.approx(-10.0, rel=0.02)
