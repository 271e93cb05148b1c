"""The result of a simulation, and what of it is refused."""

import math
from dataclasses import replace

import numpy as np
import pytest

from models.needle import NITINOL
from models.tissue import Tissue
from sim.discretisation import Arrangement, Discretisation
from sim.kernel import memory_map
from sim.needles.run import SimulationFailed, refuse_untrustworthy
from sim.needles.setup import Setup
from sim.schedule import Schedule
from sim.simulation import simulate

TURN = Schedule(
    time_s=np.array([0.0, 0.3, 3.0]),
    drive=np.array([0.0, 90.0, 90.0]),
    free_mm=np.full(3, 50.0),
    inserted_mm=np.full(3, 100.0),
    speed_mm_s=np.zeros(3),
)
SETUP = Setup(
    needle=NITINOL,
    tissue=Tissue.uniform(viscous_n_mm_s_per_mm=0.01725),
    discretisation=Discretisation(elements=4),
    free_mm=50.0,
    inserted_mm=100.0,
)


def test_a_run_from_a_time_on_is_its_last_rows():
    (whole,) = simulate([SETUP], TURN, keep_shape=True)
    part = whole.since(1.0)
    assert part.time_s[0] == pytest.approx(1.0)
    assert np.array_equal(part.tip_deg, whole.tip_deg[-part.time_s.size :])
    assert np.array_equal(part.angles_rad, whole.angles_rad[-part.time_s.size :])
    assert whole.since(0.0) is whole


@pytest.mark.parametrize("arrangement", Arrangement)
def test_angles_of_all_nodes_are_absolute_from_chuck_to_tip(arrangement):
    cut = Discretisation(elements=4, arrangement=arrangement)
    (run,) = simulate([replace(SETUP, discretisation=cut)], TURN, keep_shape=True)
    np.testing.assert_allclose(np.degrees(run.angles_rad[:, -1]), run.tip_deg, atol=1e-6)
    np.testing.assert_allclose(np.degrees(run.angles_rad[:, 0]), run.base_deg, atol=1e-6)
    assert run.unconverged == 0


def trusted():
    """Outputs of ten steps that may be trusted."""
    return np.zeros((10, memory_map.OUTPUTS)), 0.01 * np.arange(10)


def test_what_is_finite_and_lands_passes():
    outputs, time_s = trusted()
    refuse_untrustworthy(outputs, time_s, SETUP)


@pytest.mark.parametrize("lost", [math.nan, math.inf])
def test_lost_numbers_are_refused_with_their_time(lost):
    outputs, time_s = trusted()
    outputs[4:, memory_map.O_TIP_ANGLE] = lost
    with pytest.raises(SimulationFailed, match=r"NaN or infinity at 0\.040 s"):
        refuse_untrustworthy(outputs, time_s, SETUP)


def test_a_step_that_ends_elsewhere_is_refused():
    outputs, time_s = trusted()
    outputs[-1, memory_map.O_LANDING] = 1e-6
    with pytest.raises(SimulationFailed, match="within 1e-08 rad"):
        refuse_untrustworthy(outputs, time_s, SETUP)


def test_a_step_may_end_as_far_off_as_rounding_takes_it():
    """A thin needle in short elements and long steps: (c h / a)^2 = 1e9, and eps of that is 2e-7."""
    needle = NITINOL.model_copy(update={"diameter_mm": 0.5})
    element_mm = needle.wave_speed_m_s * 0.04 * 1e3 / math.sqrt(1e9)
    thin = replace(
        SETUP,
        needle=needle,
        free_mm=0.0,
        inserted_mm=4 * element_mm,
        discretisation=Discretisation(elements=4, step_s=0.04),
    )
    outputs, time_s = trusted()
    outputs[:, memory_map.O_TIP_ANGLE] = 1.0
    outputs[-1, memory_map.O_LANDING] = 1e-7
    refuse_untrustworthy(outputs, time_s, thin)
    outputs[-1, memory_map.O_LANDING] = 1e-6
    with pytest.raises(SimulationFailed, match="within 2e-07 rad"):
        refuse_untrustworthy(outputs, time_s, thin)
