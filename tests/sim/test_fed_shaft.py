"""A shaft that comes out of a chuck which stands still, against the equation of its twist.

In tissue of damping b, a shaft of rigidity GJ that slides in at v = dl/dt obeys

    b (d theta/dt + v d theta/dx) = GJ d2 theta/dx2 over 0 < x < l(t),
    GJ d theta/dx (0) = GJ (theta(0) - base) / free,   GJ d theta/dx (l) = -tip torque.
"""

from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from models import units
from models.needle import NITINOL
from models.tissue import Tissue
from sim.discretisation import Discretisation, Mesh
from sim.needles.setup import Setup
from sim.schedule import Schedule
from sim.simulation import simulate

BETA, FREE_MM = 0.01725, 50.0
TIMES = np.array([0.0, 0.5, 1.5, 4.0, 8.0])
BASE_DEG = np.array([0.0, 0.0, 90.0, 90.0, -60.0])
TORQUE_N_MM = np.array([0.0, 0.2, 0.2, 0.2, 0.2])


def lengths_mm(speed_mm_s, time_s):
    return 60.0 + max(0.0, -8 * speed_mm_s) + speed_mm_s * np.asarray(time_s)


def by_lines(speed_mm_s, at_s, cells=300):
    """Tip angle, deg, at some times: lines over x / l(t), of second order in 1 / cells."""
    rigidity = NITINOL.rigidity_n_mm2
    xi, step = np.linspace(0, 1, cells + 1), 1 / cells

    def rate(t, theta):
        length = lengths_mm(speed_mm_s, t)
        base = np.interp(t, TIMES, BASE_DEG) * units.DEG
        at_entry = length * (theta[0] - base) / FREE_MM
        at_tip = -length * np.interp(t, TIMES, TORQUE_N_MM) / rigidity
        around = np.concatenate(
            [[theta[1] - 2 * step * at_entry], theta, [theta[-2] + 2 * step * at_tip]]
        )
        slope = (around[2:] - around[:-2]) / (2 * step)
        bend = (around[2:] - 2 * theta + around[:-2]) / step**2
        return rigidity / BETA * bend / length**2 + speed_mm_s * (xi - 1) / length * slope

    found = np.zeros(cells + 1)
    tips = [0.0]
    for start, end in pairwise(at_s):
        run = solve_ivp(rate, (start, end), found, "BDF", rtol=1e-7, atol=1e-9)
        found = run.y[:, -1]
        tips.append(found[-1] / units.DEG)
    return np.array(tips)


def simulated(speed_mm_s, needle=NITINOL):
    depth = lengths_mm(speed_mm_s, TIMES)
    fed = Schedule(
        time_s=TIMES,
        drive=BASE_DEG,
        free_mm=np.full(5, FREE_MM),
        inserted_mm=depth,
        speed_mm_s=np.full(5, speed_mm_s),
        tip_torque_n_mm=TORQUE_N_MM,
    )
    assert fed.mesh is Mesh.FED
    setup = Setup(
        needle=needle,
        tissue=Tissue.uniform(viscous_n_mm_s_per_mm=BETA),
        discretisation=Discretisation(elements=96),
        mesh=fed.mesh,
        free_mm=FREE_MM,
        inserted_mm=fed.longest_mm - FREE_MM,
    )
    return simulate([setup], fed)[0]


@pytest.mark.parametrize("speed_mm_s", [6.0, -6.0])
def test_a_fed_shaft_turns_as_the_equation_of_its_twist_says(speed_mm_s):
    run = simulated(speed_mm_s)
    at = np.array([0.0, 0.5, 1.5, 2.5, 4.0, 6.0, 8.0])
    tip = np.interp(at, run.time_s, run.tip_deg)
    # Angles are linear along an element: its share of the 80 deg of twist, squared, over 8, is
    # (1 / 96)^2 / 8 * 80 = 0.001 deg at each of its ends inside an element. Without the sliding
    # 0.3 deg would be missing.
    assert np.abs(tip - by_lines(speed_mm_s, at)).max() < 0.01


@pytest.mark.parametrize("speed_mm_s", [6.0, -6.0])
def test_friction_under_load_acts_at_the_tip_of_a_fed_shaft(speed_mm_s):
    """Once it turns steadily backwards, the base carries the share of the tip's torque as well."""
    coefficient = 0.3
    loaded = simulated(speed_mm_s, NITINOL.model_copy(update={"load_coefficient": coefficient}))
    plain = simulated(speed_mm_s)
    steady = loaded.time_s >= 7.0  # 3 s of 4 after the reversal: the slowest mode takes 0.5 s
    more = (loaded.base_torque_n_mm - plain.base_torque_n_mm)[steady]
    tip = (loaded.tip_deg - plain.tip_deg)[steady] * units.DEG
    entry = -more * FREE_MM / NITINOL.rigidity_n_mm2
    # Both turn alike, so that of the damping only what the sliding of more twist takes is left.
    sliding = BETA * speed_mm_s * (tip - entry)
    np.testing.assert_allclose(more, -coefficient * TORQUE_N_MM[-1] + sliding, rtol=2e-3)
