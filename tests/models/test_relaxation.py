"""Relaxing modes against integration."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from models.errors import InvalidValue
from models.relaxation import relaxing_modes

POLES, SHARES = np.array([-0.2, -3.0, -200.0]), np.array([0.3, 1.2, -0.5])
TIME = np.array([0.0, 0.1, 0.4, 1.0, 1.3])
BASE = np.array([0.0, 0.5, 1.5, 1.5, 1.0])


def test_every_mode_follows_its_equation_over_straight_pieces():
    exact = relaxing_modes(TIME, BASE, POLES, SHARES)
    c = np.zeros(3)
    for i in range(1, TIME.size):
        rate = (BASE[i] - BASE[i - 1]) / (TIME[i] - TIME[i - 1])
        c = solve_ivp(
            lambda _, y, u=rate: POLES * y - SHARES * u,
            TIME[i - 1 : i + 1],
            c,
            method="LSODA",
            rtol=1e-10,
            atol=1e-13,
        ).y[:, -1]
        # rtol of the solver, a few hundred steps of it
        assert exact[i] == pytest.approx(c, rel=1e-7, abs=1e-10)


def test_samples_between_the_corners_change_nothing():
    finer = np.unique(np.concatenate([TIME, np.linspace(0, 1.3, 40)]))
    whole = relaxing_modes(finer, np.interp(finer, TIME, BASE), POLES, SHARES)
    at = np.searchsorted(finer, TIME)
    assert whole[at] == pytest.approx(relaxing_modes(TIME, BASE, POLES, SHARES), abs=1e-13)


def test_times_that_do_not_increase_are_refused():
    with pytest.raises(InvalidValue, match="time_s"):
        relaxing_modes([0.0, 1.0, 1.0], [0.0, 1.0, 1.0], POLES, SHARES)
