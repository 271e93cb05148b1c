"""A shaft whose material damps, against closed forms of a Kelvin-Voigt solid."""

import numpy as np
import pytest
from shaft_runs import FREE_MM, INSERTED_MM, run_of

from models.needle import NITINOL
from models.tissue import Tissue
from sim.kernel import memory_map

TIME_S = 0.3
DAMPED = NITINOL.but(damping_time_s=TIME_S)
VISCOUS = Tissue.uniform(viscous_n_mm_s_per_mm=0.02)


def test_while_it_twists_the_torque_is_that_of_the_twist_and_of_its_rate():
    """Below the level the tip sticks: torque = k (twist + time * rate), while the base turns evenly."""
    time_s = np.arange(0.0, 1.0, 0.005)
    run = run_of(12.0 * time_s, time_s, DAMPED)
    twist = np.radians(run.base_deg - run.tip_deg)
    stiffness = NITINOL.rigidity_n_mm2 / (FREE_MM + INSERTED_MM)
    expected = stiffness * (twist + TIME_S * np.gradient(twist, time_s))
    later = time_s > 0.1
    assert TIME_S * np.radians(12.0) > 0.2 * twist[-1]
    np.testing.assert_allclose(run.base_torque_n_mm[later][:-1], expected[later][:-1], rtol=2e-3)


def test_a_twist_that_does_not_change_is_not_damped():
    time_s = np.arange(0.0, 6.0, 0.01)
    ends = [run_of(40.0 * time_s, time_s, needle, VISCOUS) for needle in (DAMPED, NITINOL)]
    damped, elastic = ((run.tip_deg[-1], run.base_torque_n_mm[-1]) for run in ends)
    assert damped == pytest.approx(elastic, rel=1e-6)
    assert np.abs(ends[0].tip_deg - ends[1].tip_deg).max() > 0.5


def test_what_the_drive_puts_in_is_dissipated_or_stored():
    time_s = np.arange(0.0, 2.0, 0.01)
    run = run_of(90.0 * np.sin(4.0 * time_s) ** 2, time_s, DAMPED, VISCOUS)
    columns = [memory_map.O_WORK, memory_map.O_DISSIPATED, memory_map.O_SHAFT_ENERGY]
    work, dissipated, stored = run.outputs[:, columns].T
    # Both sums are of second order in the step: of 3 rad/s^2 and 0.01 s, parts in a thousand.
    assert np.abs(work - dissipated - stored).max() < 5e-3 * work.max()
    elastic = run_of(90.0 * np.sin(4.0 * time_s) ** 2, time_s, NITINOL, VISCOUS)
    assert abs(dissipated[-1] / elastic.outputs[-1, memory_map.O_DISSIPATED] - 1.0) > 0.02


def test_the_error_of_a_step_is_of_second_order():
    """Halved steps change a fourth as much."""
    ends = []
    for step_s in (0.04, 0.02, 0.01):
        time_s = np.arange(0.0, 2.0 + step_s / 2, step_s)
        ends.append(run_of(200.0 * np.sin(3.0 * time_s) ** 2, time_s, DAMPED, VISCOUS).tip_deg[-1])
    assert (ends[0] - ends[1]) / (ends[1] - ends[2]) == pytest.approx(4.0, rel=0.3)
