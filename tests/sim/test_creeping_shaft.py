"""A shaft that creeps, against closed forms of a standard linear solid."""

import numpy as np
import pytest
from shaft_runs import FREE_MM, INSERTED_MM, LEVEL_N_MM, run_of

from models.errors import InvalidValue
from models.needle import NITINOL
from models.tissue import Tissue

RATIO, TIME_S = 0.5, 0.4
CREEPS = NITINOL.but(creep_ratio=RATIO, creep_time_s=TIME_S)


def test_a_torque_twists_the_shaft_further_in_the_end():
    """Dry friction at the tip holds a torque that the whole shaft carries."""
    time_s = np.arange(0.0, 8.0, 0.01)
    run = run_of(60.0 * time_s, time_s, CREEPS)
    elastic = np.degrees(LEVEL_N_MM * (FREE_MM + INSERTED_MM) / NITINOL.rigidity_n_mm2)
    lag = run.base_deg[-1] - run.tip_deg[-1]
    assert lag == pytest.approx((1.0 + RATIO) * elastic, rel=1e-4)


def test_a_twist_that_is_held_relaxes_with_its_time():
    """Below the level the tip sticks: torque = k twist (1 + c exp(-t (1 + c) / tau)) / (1 + c)."""
    time_s = np.arange(0.0, 2.0, 0.005)
    turned_deg = 10.0 * np.clip(time_s / 0.02, 0.0, 1.0)
    run = run_of(turned_deg, time_s, CREEPS)
    stiffness = NITINOL.rigidity_n_mm2 / (FREE_MM + INSERTED_MM)
    left = RATIO * np.exp(-(time_s - 0.01) * (1.0 + RATIO) / TIME_S)
    twist = np.radians(run.base_deg[-1] - run.tip_deg)
    expected = stiffness * twist * (1.0 + left) / (1.0 + RATIO)
    later = time_s > 0.05
    # The ramp of 0.02 s counts as a step in its middle: second order in 0.02 (1 + c) / tau.
    np.testing.assert_allclose(run.base_torque_n_mm[later], expected[later], rtol=3e-3)


def test_the_error_of_a_step_is_of_second_order():
    """Halved steps change a fourth as much."""
    viscous, ends = Tissue.uniform(viscous_n_mm_s_per_mm=0.02), []
    for step_s in (0.04, 0.02, 0.01):
        time_s = np.arange(0.0, 2.0 + step_s / 2, step_s)
        run = run_of(200.0 * np.sin(3.0 * time_s) ** 2, time_s, CREEPS, viscous)
        ends.append(run.tip_deg[-1])
    assert (ends[0] - ends[1]) / (ends[1] - ends[2]) == pytest.approx(4.0, rel=0.3)


@pytest.mark.parametrize(
    ("more", "field"),
    [({"creep_time_s": 0.0}, "creep_time_s"), ({"yield_torque_n_mm": 1.0}, "creep_ratio")],
)
def test_a_creep_that_makes_no_sense_is_refused(more, field):
    with pytest.raises(InvalidValue, match=field):
        CREEPS.but(**more)
