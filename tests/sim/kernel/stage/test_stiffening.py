"""Springs whose stiffness depends on the torque that they carry."""

import numpy as np
import pytest

from models import units
from models.needle import NITINOL, STIFFNESS_POINTS
from models.tissue import Tissue
from sim.discretisation import Discretisation
from sim.needles.run import Run
from sim.needles.setup import Setup
from sim.schedule import Schedule
from sim.simulation import simulate

MOST_N_MM = 4.0
PLACES = MOST_N_MM * (np.arange(STIFFNESS_POINTS) / (STIFFNESS_POINTS - 1)) ** 2
STIFFENING = NITINOL.but(
    stiffness_curve=(*(1.0 + 0.2 * PLACES), *(1.0 + 0.5 * PLACES)), stiffness_torque_n_mm=MOST_N_MM
)
TISSUE = Tissue.uniform(viscous_n_mm_s_per_mm=0.02)


def setup(step_s=0.01):
    cut = Discretisation(elements=4, step_s=step_s)
    return Setup(needle=STIFFENING, tissue=TISSUE, discretisation=cut, free_mm=20.0, inserted_mm=60.0)


@pytest.fixture
def stage(at_stage):
    return at_stage(setup(), turn_deg=200.0)


def test_a_factor_runs_between_its_places_and_is_level_beyond_them(interpreted, stage):
    factor_at = interpreted.stiffening.stiffness_factor
    for way, factors in ((-1.0, 1.0 + 0.2 * PLACES), (1.0, 1.0 + 0.5 * PLACES)):
        found = [factor_at(stage.head, way * place * units.N_MM)[0] for place in PLACES[1:]]
        np.testing.assert_allclose(found, factors[1:])
        beyond, rise = factor_at(stage.head, 2.0 * way * MOST_N_MM * units.N_MM)
        assert (beyond, rise) == (pytest.approx(factors[-1]), 0.0)


def test_the_rise_is_the_derivative_of_the_logarithm(interpreted, stage):
    factor_at = interpreted.stiffening.stiffness_factor
    for torque in np.array([0.3, 1.0, 3.7, -2.0]) * units.N_MM:
        below, above = (np.log(factor_at(stage.head, torque * step)[0]) for step in (0.9999, 1.0001))
        expected = (above - below) / np.log(1.0001 / 0.9999)
        assert factor_at(stage.head, torque)[1] == pytest.approx(expected, rel=1e-4)


def test_the_slopes_of_the_residual_are_its_derivatives(interpreted, stage):
    """With those of the other parts, which are linear."""
    w, g = stage.w, stage.frame.g

    def residual(rates):
        w.omega[:] = rates
        interpreted.stiffening.set_springs(stage.head, w, g)
        interpreted.assemble.add_linear(w, g, True)
        interpreted.stiffening.add_stiffening(stage.head, w, g)
        return w.rhs.copy()

    rates = w.omega.copy()
    here = residual(rates)
    matrix = np.diag(w.diagonal) + np.diag(w.upper[:-1], 1) + np.diag(w.lower[1:], -1)
    step = 1e-5
    for i in range(rates.size):
        moved = residual(rates + step * np.eye(rates.size)[i])
        np.testing.assert_allclose(-(moved - here) / step, matrix[:, i], atol=1e-4 * abs(matrix).max())


def turned(step_s: float) -> Run:
    time_s = np.arange(0.0, 2.0 + step_s / 2, step_s)
    inputs = Schedule(
        time_s=time_s,
        drive=200.0 * np.sin(3.0 * time_s) ** 2,
        free_mm=np.full(time_s.shape, 20.0),
        inserted_mm=np.full(time_s.shape, 60.0),
        speed_mm_s=np.zeros(time_s.shape),
    )
    return simulate([setup(step_s)], inputs)[0]


def test_the_error_of_a_step_is_of_second_order():
    """Halved steps change a fourth as much."""
    ends = [turned(step_s).tip_deg[-1] for step_s in (0.04, 0.02, 0.01)]
    assert (ends[0] - ends[1]) / (ends[1] - ends[2]) == pytest.approx(4.0, rel=0.3)
